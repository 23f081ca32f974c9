#include <cstdio>

#include "../command.h"
#include "../progress_line.h"
#include "../report_pictures.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/report/pdf_writer.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

int report(Context& context, const std::string& case_id, std::string out)
{
    CaseStore& store = context.existingStore();
    const CaseRecord record = store.requireCase(case_id);
    report::ReportContent content;
    content.a_case = record;
    content.created = nowUtc();
    content.software_version = VICON_VERSION;
    content.number = store.nextNumber("report " + record.id);
    ProgressLine progress("report");
    const PictureFolder pictures;
    content.scans = drawScans(store, record, pictures, progress);
    content.markers = drawMarkers(store, record, content.scans, pictures, progress);
    if (out.empty()) {
        const fs::path folder = store.caseFolder(record.id) / "report";
        makePrivateFolder(folder);
        out = (folder / (std::to_string(content.number) + ".pdf")).string();
    }
    const report::PdfResult written = report::writePdf(content, out, context.config().get<report::ReportOptions>());
    store.audit("report written", record.id, "", "number " + std::to_string(content.number));
    progress.clear();
    for (const std::string& warning : written.warnings)
        std::fprintf(stderr, "vicon: %s\n", warning.c_str());
    if (context.json)
        std::printf(
            "%s\n",
            nlohmann::json{
                {"file", out}, {"pages", written.pages}, {"number", content.number}, {"warnings", written.warnings}}
                .dump(2)
                .c_str());
    else
        std::printf("report %d, %d pages, %zu markers\n%s\n", content.number, written.pages, content.markers.size(),
                    out.c_str());
    return 0;
}

}  // namespace

Subcommand reportCommand()
{
    return {"report", "Write a case's report as PDF", [](CLI::App& command) {
                auto case_id = std::make_shared<std::string>(), out = std::make_shared<std::string>();
                command.add_option("CASE", *case_id, "The case's id")->required();
                command.add_option("--out", *out, "The PDF file (default: in the store)")->type_name("FILE");
                return [case_id, out](Context& context) { return report(context, *case_id, *out); };
            }};
}

}  // namespace vicon::app
