#include <cstdio>

#include "../command.h"
#include "../progress_line.h"
#include "../report_writing.h"

namespace vicon::app {
namespace {

int report(Context& context, const std::string& case_id, std::string out)
{
    ProgressLine progress("report");
    const WrittenReport written = writeReport(context.existingStore(), context.config(), case_id, out, progress);
    out = written.file.string();
    progress.clear();
    for (const std::string& warning : written.warnings)
        std::fprintf(stderr, "vicon: %s\n", warning.c_str());
    if (context.json)
        std::printf(
            "%s\n",
            nlohmann::json{
                {"file", out}, {"pages", written.pages}, {"number", written.number}, {"warnings", written.warnings}}
                .dump(2)
                .c_str());
    else
        std::printf("report %d, %d pages, %zu markers\n%s\n", written.number, written.pages, written.markers,
                    out.c_str());
    return 0;
}

}  // namespace

Subcommand reportCommand()
{
    return {"report", "Write a case's report as PDF", [](CommandLine& command) {
                auto case_id = std::make_shared<std::string>(), out = std::make_shared<std::string>();
                command.option("CASE", *case_id, "The case's id").required();
                command.option("--out", *out, "The PDF file (default: in the store)").typeName("FILE");
                return [case_id, out](Context& context) { return report(context, *case_id, *out); };
            }};
}

}  // namespace vicon::app
