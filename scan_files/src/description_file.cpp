#include "vicon/scan_files/description_file.h"

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/json_text.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace vicon::scan_files {
namespace {

constexpr const char* kFile = "scan.json";

/// What readers of a scan ask for first of the steps' results, at the top level under the contract's names.
constexpr const char* kAskedForFirst[] = {"bridges", "parts", "quality", "verdict", "confidence", "organ"};
constexpr const char* kOwnKeys[] = {"case",     "scan", "patient", "study", "series",
                                    "position", "role", "created", "steps"};

json formOf(const StepRecord& step)
{
    return {{"version", step.version}, {"digest", step.digest},   {"parameters", step.parameters},
            {"result", step.result},   {"seconds", step.seconds}, {"finished", step.finished}};
}

StepRecord stepFrom(const std::string& name, const json& form)
{
    return {.step = name,
            .version = wholeNumber(form.at("version")),
            .digest = form.at("digest").get<std::string>(),
            .parameters = form.at("parameters"),
            .result = form.at("result"),
            .seconds = form.at("seconds").get<double>(),
            .finished = form.at("finished").get<std::string>()};
}

}  // namespace

json toJson(const ScanDescription& of)
{
    json out = {{"case", of.case_id},      {"scan", of.scan_id},
                {"patient", of.patient},   {"study", of.study},
                {"series", of.series},     {"position", positionName(of.series.patient_position)},
                {"role", nameOf(of.role)}, {"created", of.created}};
    out.update(of.ingest);
    json& done = out["steps"] = json::object();
    for (const StepRecord& step : of.steps) {
        done[step.step] = formOf(step);
        for (const char* key : kAskedForFirst)
            if (step.result.contains(key))
                out[key] = step.result[key];
    }
    return out;
}

ScanDescription scanDescriptionFromJson(const json& from)
{
    ScanDescription out{.case_id = from.value("case", ""),
                        .scan_id = from.value("scan", ""),
                        .patient = from.value("patient", Patient{}),
                        .study = from.value("study", Study{}),
                        .series = from.value("series", Series{}),
                        .role = scanRoleFrom(from.value("role", nameOf(ScanRole::scan))),
                        .created = from.value("created", "")};
    const json steps = from.value("steps", json::object());
    for (const auto& [name, form] : steps.items())
        out.steps.push_back(stepFrom(name, form));
    out.ingest = from;
    for (const char* key : kOwnKeys)
        out.ingest.erase(key);
    for (const char* key : kAskedForFirst)
        out.ingest.erase(key);
    return out;
}

void writeDescription(const fs::path& scan_folder, const ScanDescription& description)
{
    replaceFile(scan_folder / kFile, toJson(description).dump(2) + "\n");
}

ScanDescription readDescription(const fs::path& scan_folder)
{
    const fs::path file = scan_folder / kFile;
    const auto refuse = [&](const std::string& why) {
        throw Error(ErrorCode::bad_input, "is not the description of a scan" + why, file.string(), "run 'vicon work'");
    };
    if (!fs::exists(file))
        return {};
    const json description = parsedJson(readFile(file));
    if (!description.is_object())
        refuse("");
    try {
        return scanDescriptionFromJson(description);
    } catch (const json::exception& e) {
        refuse(std::string(": ") + e.what());
    } catch (const Error& e) {
        refuse(std::string(": ") + e.what());
    }
    return {};
}

bool isDescribedBy(const fs::path& scan_folder, const ScanDescription& description)
try {
    return fs::exists(scan_folder / kFile) && toJson(readDescription(scan_folder)) == toJson(description);
} catch (const Error&) {
    return false;
}

}  // namespace vicon::scan_files
