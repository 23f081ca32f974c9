#include "vicon/core/options.h"

#include <gmock/gmock.h>

#include <fstream>

#include "vicon/core/error.h"
#include "vicon/core/geometry_json.h"
#include "vicon/support/support.h"

namespace vicon {
namespace {

using testing::HasSubstr;

struct Sample {
    double wall_hu = -480;
    int rays = 64;
    bool fast = true;
    std::string method = "auto";
    std::vector<Point3> seeds;
    std::vector<std::string> people;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("sample.wall_hu", wall_hu, "HU", "Half-way density.", {-1000, 0});
        v("sample.rays", rays, "", "Rays.", {8, 512});
        v("sample.fast", fast, "", "Be fast.");
        v("sample.method", method, "", "How.", {.choices = {"auto", "binary"}});
        v("sample.seeds", seeds, "mm", "Where.");
        v("sample.people", people, "", "Who.");
    }
};

Config declared()
{
    Config config;
    config.declare(specsOf<Sample>());
    return config;
}

std::string messageOf(const std::function<void()>& action)
{
    try {
        action();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::wrong_use);
        return e.what();
    }
    return "nothing was thrown";
}

TEST(Options, HaveTheStructsDefaultsUntilSomethingElseIsSaid)
{
    const Config config = declared();
    const auto sample = config.get<Sample>();
    EXPECT_EQ(sample.wall_hu, -480);
    EXPECT_EQ(sample.method, "auto");
    EXPECT_EQ(config.at("sample.rays").source, "default");
}

TEST(Options, ComeFromTheFileAndThenFromTheCommandLine)
{
    const support::TemporaryFolder folder;
    std::ofstream(folder / "c.toml")
        << "[sample]\nwall_hu = -500\nrays = 32\n[peers.pacs]\nhost = \"localhost\"\nport = 4242\n";
    Config config = declared();
    config.readFile(folder / "c.toml");
    config.set("sample.rays=16");
    const auto sample = config.get<Sample>();
    EXPECT_EQ(sample.wall_hu, -500);
    EXPECT_EQ(sample.rays, 16);
    EXPECT_THAT(config.at("sample.wall_hu").source, HasSubstr("c.toml:2"));
    EXPECT_EQ(config.at("sample.rays").source, "command line");
    EXPECT_EQ(config.peers()["pacs"]["port"], 4242);
}

TEST(Options, RefuseWhatIsWrongWithOneLineThatNamesIt)
{
    Config config = declared();
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"sample.wall=-5", "did you mean 'sample.wall_hu'"},
        {"nonsense", "not key=value"},
        {"sample.wall_hu=5", "between -1000 and 0"},
        {"sample.rays=2.5", "a whole number"},
        {"sample.fast=maybe", "true or false"},
        {"sample.method=magic", "auto, binary"},
        {"sample.seeds=1,2", "must be points"},
        {"sample.seeds=a,b,c", "must be points"},
        {"sample.seeds=[[1,2]]", "must be points"},
        {"sample.seeds=1,2,3,4", "must be points"},
    };
    for (const auto& [assignment, words] : cases)
        EXPECT_THAT(messageOf([&] { config.set(assignment); }), HasSubstr(words)) << assignment;
}

TEST(Options, TakePointsAsAListOrAsAText)
{
    const support::TemporaryFolder folder;
    const std::vector<Point3> two{{1.5, -2, 3}, {4, 5, 6}};
    for (const std::string text : {"1.5,-2,3;4,5,6", "[[1.5, -2, 3], [4, 5, 6]]", " 1.5, -2, 3 ; 4, 5, 6;"}) {
        Config config = declared();
        config.set("sample.seeds=" + text);
        EXPECT_EQ(config.get<Sample>().seeds, two) << text;
    }
    for (const std::string text : {"[[1.5, -2, 3], [4, 5, 6]]", "\"1.5,-2,3;4,5,6\""}) {
        std::ofstream(folder / "c.toml") << "[sample]\nseeds = " << text << "\n";
        Config config = declared();
        config.readFile(folder / "c.toml");
        EXPECT_EQ(config.get<Sample>().seeds, two) << text;
        EXPECT_EQ(config.at("sample.seeds").value.dump(), "[[1.5,-2,3],[4,5,6]]");
    }
    Config config = declared();
    config.set("sample.seeds=1,2,3");
    config.set("sample.seeds=");
    EXPECT_TRUE(config.get<Sample>().seeds.empty());
}

TEST(Options, NameFileAndLineOfAMistake)
{
    const support::TemporaryFolder folder;
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"[sample]\n\nrays = \"many\"\n", "c.toml:3"},     {"[sample\n", "c.toml:1"},
        {"rays = 3\n", "is not a table; write [rays]"},    {"[peers.pacs]\nhost = \"x\"\n", "host and port"},
        {"[sample]\nwall_hu = nan\n", "must lie between"}, {"[sample]\nwall_hu = inf\n", "must lie between"},
    };
    for (const auto& [text, words] : cases) {
        std::ofstream(folder / "c.toml") << text;
        Config config = declared();
        EXPECT_THAT(messageOf([&] { config.readFile(folder / "c.toml"); }), HasSubstr(words)) << text;
    }
}

TEST(Options, AreRecordedAsJson)
{
    EXPECT_EQ(toJson(Sample{.rays = 9})["sample.rays"], 9);
}

TEST(Options, TakeAListOfTexts)
{
    const support::TemporaryFolder folder;
    const auto people = [](const Config& config) { return config.get<Sample>().people; };
    const auto read = [&](const std::string& line) {
        std::ofstream(folder / "c.toml") << "[sample]\n" << line << "\n";
        Config config = declared();
        config.readFile(folder / "c.toml");
        return config;
    };
    EXPECT_THAT(people(declared()), testing::IsEmpty());
    EXPECT_THAT(people(read("people = [\"anna\", \"b c\"]")), testing::ElementsAre("anna", "b c"));
    EXPECT_THAT(people(read("people = \"anna\"")), testing::ElementsAre("anna"));
    Config config = declared();
    config.set("sample.people= anna , ben,,");
    EXPECT_THAT(people(config), testing::ElementsAre("anna", "ben"));
    config.set("sample.people=[\"carl\"]");
    EXPECT_THAT(people(config), testing::ElementsAre("carl"));
    for (const char* wrong : {"people = 7", "people = [7]", "people = [[1, 2, 3]]"})
        EXPECT_THAT(messageOf([&] { read(wrong); }), HasSubstr("a list of texts")) << wrong;
}

}  // namespace
}  // namespace vicon
