#include "report_writing.h"

#include "report_pictures.h"
#include "vicon/cases/report_files.h"
#include "vicon/core/file.h"
#include "vicon/report/pdf_writer.h"

namespace fs = std::filesystem;

namespace vicon::app {
WrittenReport writeReport(CaseStore& store, const Config& config, const std::string& case_id, fs::path out,
                          Progress& progress)
{
    const CaseRecord record = store.requireCase(case_id);
    requireReportable(store, record);
    report::ReportContent content;
    content.a_case = record;
    content.created = nowUtc();
    content.software_version = VICON_VERSION;
    content.number = store.nextNumber("report " + record.id);
    const PictureFolder pictures;
    content.scans = drawScans(store, record, pictures, progress);
    content.markers = drawMarkers(store, record, content.scans, pictures, progress);
    if (out.empty())
        out = reportFile(store, record.id, content.number);
    const report::PdfResult written = report::writePdf(content, out, config.get<report::ReportOptions>());
    store.audit("report written", record.id, "", "number " + std::to_string(content.number));
    return {out, content.number, written.pages, content.markers.size(), written.warnings};
}

}  // namespace vicon::app
