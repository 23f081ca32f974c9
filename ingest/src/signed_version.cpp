#include "signed_version.h"

#include "vicon/cases/report_versions.h"

namespace vicon::ingest {

int signedVersion(CaseStore& store, const std::string& case_id)
{
    int last = 0;
    for (const ReportVersion& version : reportVersions(store, case_id))
        if (version.isSigned())
            last = version.version;
    return last;
}

}  // namespace vicon::ingest
