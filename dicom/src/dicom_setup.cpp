#include "vicon/dicom/dicom_setup.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcdict.h>
#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmdata/dcrleerg.h>
#include <dcmtk/oflog/oflog.h>

#include <cstdlib>
#include <mutex>

namespace vicon {

void setUpDicom()
{
    static std::once_flag once;
    std::call_once(once, [] {
        ::setenv("TCP_NODELAY", "1", 0);            // DCMTK's own switch for connections that it opens
        OFLog::configure(OFLogger::OFF_LOG_LEVEL);  // a library prints nothing, and DCMTK's messages may name patients
        // Read now: its first use by several threads at once is not safe.
        dcmDataDict.rdlock();
        dcmDataDict.rdunlock();
        // What VICON itself compresses, and unpacks again for a peer that takes no RLE; what comes in is decoded in the
        // helper process alone.
        DcmRLEEncoderRegistration::registerCodecs();
        DcmRLEDecoderRegistration::registerCodecs();
    });
}

}  // namespace vicon
