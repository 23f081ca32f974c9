// Whatever a structured report from elsewhere holds, it is read or refused in one line; what was read of it can be
// kept, listed, and compared with a colon of today.
#include <cmath>
#include <nlohmann/json.hpp>

#include "memory_file.h"
#include "one_line.h"
#include "vicon/cases/prior_match.h"
#include "vicon/core/error.h"
#include "vicon/ingest/structured_report.h"
#include "vicon/report/prior_reading.h"

using namespace vicon;

namespace {

constexpr double kColon_mm = 1500;

/// Numbers are as priors.schema.json has them: none is infinite, no length and no volume below nothing.
void requireNumbers(const std::string& name, const nlohmann::json& json)
{
    if (json.is_number())
        fuzz::require(std::isfinite(json.get<double>()) &&
                      (json >= 0 || !(name.ends_with("_mm") || name.ends_with("_ml"))));
    else if (json.is_object())
        for (const auto& [key, value] : json.items())
            requireNumbers(key, value);
    else if (json.is_array())
        for (const auto& value : json)
            requireNumbers("", value);
}

void requireSound(const PriorReport& report)
{
    const nlohmann::json json{toJson(report), report.patient};
    (void)json.dump();
    requireNumbers("", json);
    fuzz::requireLine(inBrief(report));
    for (const std::string& line : report.not_read)
        fuzz::requireLine(line);
    const ScanColon colon{"s", "supine", kColon_mm, {{ColonPart::rectum, 0, 150}, {ColonPart::sigmoid, 150, 500}}};
    for (const PriorFinding& finding : report.findings) {
        fuzz::require(!finding.uid.empty() && finding.lead());
        fuzz::requireLine(labelOf(report, finding));
        fuzz::require(finding.name.find('\n') == std::string::npos);
        if (const auto place = expectedIn(report, finding, colon, {}))
            fuzz::require(place->station_mm >= 0 && place->station_mm <= kColon_mm);
    }
    fuzz::require(matchFindings(report, {}, {colon}, {}).size() == report.findings.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::MemoryFile file;
    file.fill(data, size);
    try {
        const ContentDocument document = ingest::readStructuredReport(file.path());
        fuzz::require(!document.sop_uid.empty() && !document.study.uid.empty());
        requireSound(report::priorFrom(document));
    } catch (const Error& e) {
        fuzz::require(e.code() == ErrorCode::bad_input);
        fuzz::requireLine(e.what());
    }
    return 0;
}
