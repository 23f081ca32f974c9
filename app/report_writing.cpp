#include "report_writing.h"

#include "organs.h"
#include "report_pictures.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/report/pdf_writer.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

/// A report tells of colons: a case that shows other organs alone has none.
void refuseOtherOrgans(CaseStore& store, const CaseRecord& record)
{
    std::string others;
    for (const ScanRecord& scan : store.scans(record.id)) {
        if (scan.role != "scan")
            continue;
        const std::string organ = organOf(store, scan);
        if (organ == "colon")
            return;
        others += (others.empty() ? "" : ", ") + organ;
    }
    if (!others.empty())
        throw Error(ErrorCode::unusable_scan, "a report tells of a colon; the scans of this case show the " + others,
                    record.id, "'vicon show', 'vicon fly' and 'vicon snapshot' work on them");
}

}  // namespace

WrittenReport writeReport(CaseStore& store, const Config& config, const std::string& case_id, fs::path out,
                          Progress& progress)
{
    const CaseRecord record = store.requireCase(case_id);
    refuseOtherOrgans(store, record);
    report::ReportContent content;
    content.a_case = record;
    content.created = nowUtc();
    content.software_version = VICON_VERSION;
    content.number = store.nextNumber("report " + record.id);
    const PictureFolder pictures;
    content.scans = drawScans(store, record, pictures, progress);
    content.markers = drawMarkers(store, record, content.scans, pictures, progress);
    if (out.empty()) {
        const fs::path folder = store.caseFolder(record.id) / "report";
        makePrivateFolder(folder);
        out = folder / (std::to_string(content.number) + ".pdf");
    }
    const report::PdfResult written = report::writePdf(content, out, config.get<report::ReportOptions>());
    store.audit("report written", record.id, "", "number " + std::to_string(content.number));
    return {out, content.number, written.pages, content.markers.size(), written.warnings};
}

}  // namespace vicon::app
