// Whatever a file holds, the walk over its elements ends, within its memory. Where it says that it followed each of
// them, DCMTK reads them in the same transfer syntax, and finds them nested no deeper.
#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include "memory_file.h"
#include "structure_scan.h"
#include "vicon/dicom/dicom_setup.h"
#include "vicon/dicom/load_file.h"

using namespace vicon;
using ingest::Structure;

namespace {

void requireNoDeeper(DcmObject& parent, int sequences)
{
    fuzz::require(sequences <= ingest::kDeepestSequence);
    for (DcmObject* next = parent.nextInContainer(nullptr); next; next = parent.nextInContainer(next))
        if (!next->isLeaf())
            requireNoDeeper(*next, sequences + (next->ident() == EVR_SQ ? 1 : 0));
}

void requireThatDcmtkAgrees(const std::filesystem::path& file, const Structure& clear)
{
    DcmFileFormat format;
    const bool whole = loadFile(format, file).good();
    requireNoDeeper(*format.getMetaInfo(), 0);
    requireNoDeeper(*format.getDataset(), 0);
    if (!whole)  // damaged values are another matter, and so are a few bytes that are no element
        return;
    const E_TransferSyntax read = format.getDataset()->getOriginalXfer();
    // A file that ends with its meta header has no data set to be read in any.
    fuzz::require(read == EXS_Unknown || DcmXfer(read).getXferID() == clear.transfer_syntax);
    fuzz::require(read != EXS_Unknown || format.getDataset()->card() == 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::MemoryFile file;
    setUpDicom();
    file.fill(data, size);
    const Structure found = ingest::scanStructure(file.path());
    fuzz::require(found.fate != Structure::Fate::refused || !found.why.empty());
    fuzz::require(found.trailing_bytes <= size);
    fuzz::require((found.fate == Structure::Fate::clear) == !found.transfer_syntax.empty());
    if (found.fate == Structure::Fate::clear)
        requireThatDcmtkAgrees(file.path(), found);
    return 0;
}
