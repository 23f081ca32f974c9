#include "study.h"

#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

std::string contentOf(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

/// Takes out of scan.json what says when, and how long something took.
void removeTimes(nlohmann::json& json)
{
    if (json.is_object())
        for (const char* key : {"created", "finished", "seconds"})
            json.erase(key);
    if (json.is_structured())
        for (auto& child : json)
            removeTimes(child);
}

/// The schema of what a subcommand prints with --json; most have its name.
std::string schemaOf(const std::string& arguments)
{
    static const std::map<std::string, std::string> others = {
        {"assess", "finding"}, {"export", "report"},         {"mark", "marker"},
        {"restore", "backup"}, {"report", "written_report"}, {"send", "outbox"},
    };
    const std::string subcommand = arguments.substr(0, arguments.find(' '));
    if (subcommand == "query" && arguments.find("--worklist") != std::string::npos)
        return "query_worklist";
    const auto other = others.find(subcommand);
    return other == others.end() ? subcommand : other->second;
}

}  // namespace

void expectSchema(const std::string& schema, const nlohmann::json& json)
{
    const TemporaryFolder folder;
    std::ofstream(folder / "printed.json") << json;
    EXPECT_EQ(schemaFaults(schema, {folder / "printed.json"}), "") << schema;
}

std::string viconOn(const fs::path& store, const std::string& arguments)
{
    const CommandResult result = runVicon(arguments + " --store " + store.string());
    EXPECT_EQ(result.exit_code, 0) << "vicon " << arguments << "\n" << result.output;
    return result.output;
}

nlohmann::json viconJson(const fs::path& store, const std::string& arguments)
{
    // Progress goes to stderr; what is parsed is stdout alone.
    const CommandResult result =
        runCommand("(" + viconBinary() + " " + arguments + " --json --store " + store.string() + " 2>/dev/null)");
    EXPECT_EQ(result.exit_code, 0) << "vicon " << arguments << "\n" << result.output;
    auto json = nlohmann::json::parse(result.output, nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << arguments;
    static std::set<std::string> held;
    if (const std::string schema = schemaOf(arguments); !json.is_discarded() && held.insert(schema).second)
        expectSchema(schema, json);
    return json;
}

const fs::path& smallStudy()
{
    static const TemporaryFolder folder;
    static const fs::path study = [] {
        const auto made = runVicon("phantom " + (folder / "study").string() +
                                   " --supine --size 160x160x134 --no-folds --gap 0 --seed 3");
        EXPECT_EQ(made.exit_code, 0) << made.output;
        return folder / "study";
    }();
    return study;
}

std::vector<ListedScan> listedScans(const fs::path& store)
{
    std::vector<ListedScan> scans;
    const auto worklist = viconJson(store, "cases");
    for (const auto& c : worklist["cases"])
        for (const auto& s : c["scans"])
            if (s["state"] != "kept")
                scans.push_back({c["id"], s["id"], s["position"], s["state"], s["folder"].get<std::string>()});
    return scans;
}

ListedScan readSmallStudy(const fs::path& store, const std::string& facts)
{
    viconOn(store, "import " + smallStudy().string());
    viconOn(store, "work --until-idle");
    ListedScan scan = listedScans(store).at(0);
    const nlohmann::json truth = nlohmann::json::parse(std::ifstream(smallStudy() / "truth-supine.json"));
    std::string at;
    for (const auto& coordinate : truth["polyps"][0]["position_mm"])
        at.append(at.empty() ? "" : ",").append(coordinate.dump());
    viconOn(store, "mark " + scan.case_id + " --at=" + at);
    viconOn(store, "finding " + scan.case_id + " --add m1 --kind polyp --size 7 " + facts);
    viconOn(store, "assess " + scan.case_id + " --c-rads C2a --why test --e-rads E1 --e-why test");
    return scan;
}

std::vector<std::string> linesWithoutProgress(const std::string& output)
{
    static const std::regex progress("[^ ]+: +[0-9]+ % .*");
    std::vector<std::string> lines;
    std::istringstream said(output);
    for (std::string line; std::getline(said, line);)
        if (!std::regex_match(line, progress))
            lines.push_back(line);
    return lines;
}

std::map<std::string, std::string> filesOf(const fs::path& store)
{
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(store / "cases")) {
        if (!entry.is_regular_file())
            continue;
        std::string content = contentOf(entry.path());
        if (entry.path().filename() == "scan.json") {
            auto json = nlohmann::json::parse(content, nullptr, false);
            EXPECT_FALSE(json.is_discarded()) << entry.path() << " is half-written";
            removeTimes(json);
            content = json.dump();
        }
        all[fs::relative(entry.path(), store / "cases").string()] = std::move(content);
    }
    return all;
}

}  // namespace vicon::support
