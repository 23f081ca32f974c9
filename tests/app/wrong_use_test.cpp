#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

#include "study.h"

namespace vicon::support {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct WrongUseCase {
    std::string arguments;
    int exit_code;
    const char* words;
};

void expectOneLineEach(const std::vector<WrongUseCase>& cases)
{
    for (const WrongUseCase& c : cases) {
        const CommandResult result = runVicon(c.arguments);
        EXPECT_EQ(result.exit_code, c.exit_code) << c.arguments << "\n" << result.output;
        EXPECT_THAT(result.output, HasSubstr(c.words)) << c.arguments;
        EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << c.arguments << "\n"
                                                                                   << result.output;
    }
}

TEST(WrongUse, EndsWithTheRightCodeAndOneLineThatSaysWhatToDo)
{
    const TemporaryFolder folder;
    std::ofstream(folder / "empty.txt") << "no DICOM";
    std::ofstream(folder / "bad.toml") << "[segment]\ngas_below = 3\n";
    std::ofstream(folder / "peers.toml")
        << "[peers]\nscanner = { host = \"127.0.0.1\", port = 104, roles = [\"store\"] }\n"
           "odd = { host = \"127.0.0.1\", port = 104, role = \"store\" }\n"
           "guest = { host = \"127.0.0.1\", port = 104, roles = [\"stores\"] }\n";
    const std::string peers = " --config " + (folder / "peers.toml").string();
    const std::string store = " --store " + (folder / "store").string();
    ASSERT_EQ(runVicon("import " + (folder / "empty.txt").string() + store).exit_code, 1);
    expectOneLineEach({
        {"", 2, "subcommand"},
        {"frobnicate", 2, "there is no subcommand 'frobnicate'; 'vicon --help'"},
        {"import /nonexistent" + store, 2, "/nonexistent"},
        {"cases --store " + (folder / "none").string(), 1, "there is no store here"},
        {"show nosuchcase" + store, 1, "no such case"},
        {"mark nosuchcase --at 1,2,3" + store, 1, "no such case"},
        {"work --until-idle --config " + (folder / "bad.toml").string() + store, 2, "gas_below_hu"},
        {"work --until-idle --config /nonexistent.toml" + store, 2, "no such configuration file"},
        {"work --until-idle --set segment.gas_below_hu=5000" + store, 2, "between"},
        {"snapshot nosuchcase --view sideways --out x.png" + store, 2, "{endo,slices,overview,cube,band}"},
        {"query scanner" + peers, 2, "not to be asked"},
        {"retrieve scanner 1.2.3" + peers + store, 2, "not to be asked"},
        {"query odd" + peers, 2, "not understood"},
        {"query guest" + peers, 2, "not a role"},
        {"receive --address 0.0.0.0 --port 0" + store, 2, "[peers]"},
        {"report nosuchcase" + store, 1, "no such case"},
        {"finding nosuchcase" + store, 1, "no such case"},
        {"finding nosuchcase --add m1 --remove f1" + store, 2, "--remove"},
        {"finding nosuchcase --markers m1" + store, 2, "--change"},
        {"assess nosuchcase --accept" + store, 1, "no such case"},
        {"sign nosuchcase" + store, 1, "no such case"},
        {"amend nosuchcase --reason why --cancel" + store, 2, "--cancel"},
        {"audit nosuchcase" + store, 1, "no such case"},
        {"export nosuchcase" + store, 2, "--as"},
        {"export nosuchcase --as pdf" + store, 2, "{text,json,csv,fhir,hl7,dicom}"},
        {"phantom " + (folder / "p").string() + " --size 3x3", 2, "COLUMNSxROWSxSLICES"},
        {"phantom /proc/nowhere --size 64x64x32", 1, "/proc/nowhere"},
        {"fly nosuchcase --to moon" + store, 2, "{caecum,tip,rectum,root,both}"},
        {"read nosuchcase --demo" + store, 2, "leave out CASE"},
    });
}

TEST(WrongUse, OfPlacesAndNamesIsSaidBeforeAnythingIsTaken)
{
    const TemporaryFolder folder;
    const std::string store = " --store " + (folder / "store").string();
    constexpr std::size_t kLongerThanAnyPath = 5000;
    expectOneLineEach({
        {"frobnicate --help", 2, "there is no subcommand 'frobnicate'"},
        {"shwo nosuchcase --help", 2, "did you mean 'show'?"},
        {"--store /nonexistent import-all", 2, "there is no subcommand 'import-all'"},
        {"cases --store " + std::string(kLongerThanAnyPath, 'x'), 1, "cannot be used"},
        {"cases --store ''", 2, "is empty"},
        {"cases --config ''" + store, 2, "is empty"},
        {"cases --config " + folder.path().string() + store, 2, "the configuration cannot be read"},
        {"cases --config /dev/zero" + store, 2, "longer than any configuration"},
    });
}

TEST(WrongUse, OfNothingWhereANameIsMeantOrOfNoNumberIsRefused)
{
    const TemporaryFolder folder;
    std::ofstream(folder / "c.toml") << "[peers]\npacs = { host = \"127.0.0.1\", port = 9 }\n";
    const std::string in = " --config " + (folder / "c.toml").string() + " --store " + (folder / "store").string();
    expectOneLineEach({
        {"work --case '' --redo-outdated" + in, 2, "is empty"},
        {"outbox ''" + in, 2, "is empty"},
        {"markers nosuchcase --remove ''" + in, 2, "is empty"},
        {"finding nosuchcase --remove ''" + in, 2, "is empty"},
        {"match nosuchcase --confirm ''" + in, 2, "is empty"},
        {"query pacs --patient ''" + in, 2, "is empty"},
        {"retrieve pacs ''" + in, 2, "is empty"},
        {"retrieve pacs '1.2*'" + in, 2, "is no Study Instance UID"},
        {"retrieve pacs '1.2\\1.3'" + in, 2, "is no Study Instance UID"},
        {"snapshot nosuchcase --view endo --station nan --out x.png" + in, 2, "no finite number"},
        {"send nosuchcase pacs --wait inf" + in, 2, "no finite number"},
        {"mark nosuchcase --at 1,2,3 --biopsy nan" + in, 2, "no finite number"},
    });
}

TEST(WrongUse, WithoutAHomeNoStoreIsMadeInWhateverFolder)
{
    const CommandResult result =
        runCommand("env -u HOME -u XDG_DATA_HOME -u XDG_CONFIG_HOME -u VICON_STORE " + viconBinary() + " cases");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.output, HasSubstr("HOME is not set; name its folder with --store"));
}

TEST(Help, AnswersForEverySubcommand)
{
    const CommandResult all = runVicon("--help");
    EXPECT_EQ(all.exit_code, 0);
    for (const char* name :
         {"import", "receive", "work", "cases", "show", "mark", "markers", "fly", "snapshot", "report", "finding",
          "assess", "sign", "amend", "audit", "export", "phantom", "config", "doctor"}) {
        EXPECT_THAT(all.output, HasSubstr(name));
        const CommandResult one = runVicon(std::string(name) + " --help");
        EXPECT_EQ(one.exit_code, 0) << name;
        EXPECT_THAT(one.output, HasSubstr("--store")) << name;
    }
}

TEST(Config, SaysWhereEachValueComesFrom)
{
    const TemporaryFolder folder;
    std::ofstream(folder / "c.toml") << "[queue]\nlease_s = 33\n";
    const auto json = nlohmann::json::parse(
        runVicon("config --json --set queue.most_attempts=2 --config " + (folder / "c.toml").string()).output);
    EXPECT_EQ(json["queue.lease_s"]["value"], 33.0);
    EXPECT_THAT(json["queue.lease_s"]["source"].get<std::string>(), HasSubstr("c.toml:2"));
    EXPECT_EQ(json["queue.most_attempts"]["source"], "command line");
    EXPECT_EQ(json["queue.most_drops"]["source"], "default");
    EXPECT_EQ(json["report.paper"]["value"], "a4");
    EXPECT_EQ(json["segment.add"]["value"], nlohmann::json::array());
}

/// An empty one.
fs::path storeIn(const TemporaryFolder& folder)
{
    fs::create_directories(folder / "nothing");
    const fs::path store = folder / "store";
    runVicon("import " + (folder / "nothing").string() + " --store " + store.string());
    EXPECT_TRUE(fs::exists(store / "vicon.db"));
    return store;
}

CommandResult doctor(const fs::path& store, const std::string& more = "")
{
    return runVicon("doctor --store " + store.string() + " " + more);
}

TEST(Doctor, FindsNothingWrongHere)
{
    const TemporaryFolder folder;
    const CommandResult result = doctor(storeIn(folder));
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output, testing::ContainsRegex("ok   store +.*flush and hard links work"));
    EXPECT_THAT(result.output, testing::ContainsRegex("ok   fonts +Latin, Greek"));
    EXPECT_THAT(result.output, testing::ContainsRegex("ok   display +.*, drawn (in software )?by [A-Za-z]"));
}

TEST(Doctor, MakesNoStoreWhereNoneIs)
{
    const TemporaryFolder folder;
    const CommandResult result = doctor(folder / "typo");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.output, testing::ContainsRegex("BAD  store +.*typo: there is no store here"));
    EXPECT_THAT(result.output, Not(HasSubstr("database")));
    EXPECT_FALSE(fs::exists(folder / "typo"));
}

TEST(Doctor, SaysWhatTheConfigurationNamesAndIsNotThere)
{
    const TemporaryFolder folder;
    const fs::path store = storeIn(folder);
    std::string wrong;
    const std::pair<const char*, const char*> kOptions[] = {
        {"report.send_to", "[\"zz\"]"}, {"report.objects", "[\"bogus\"]"}, {"report.logo", "/nope.png"},
        {"orders.peer", "zz"},          {"receive.count_at", "zz"},        {"receive.tls", "required"},
        {"receive.address", "foo"},     {"metrics.address", "9.9.9.9"},    {"audit.syslog", "foo"}};
    for (const auto& [option, value] : kOptions)
        wrong += std::string(" --set '") + option + "=" + value + "'";
    const CommandResult result = doctor(store, wrong);
    EXPECT_EQ(result.exit_code, 1);
    for (const auto& [option, value] : kOptions)
        EXPECT_THAT(result.output, HasSubstr(std::string("BAD  ") + option + " "));
    EXPECT_THAT(result.output, testing::ContainsRegex("BAD  report.logo +.*/nope.png"));
    EXPECT_THAT(result.output, testing::ContainsRegex("BAD  report.send_to +zz: no peer of that name"));
}

TEST(Doctor, CallsNothingEmptyThatItMayNotLookAt)
{
    if (::geteuid() != 0)
        GTEST_SKIP() << "root alone becomes nobody";
    const TemporaryFolder folder;
    const fs::path store = storeIn(folder);
    fs::permissions(folder.path(), fs::perms::owner_all | fs::perms::others_exec);
    const std::string by_nobody = "setpriv --reuid 65534 --regid 65534 --clear-groups env HOME=/nonexistent " +
                                  viconBinary() + " doctor --store " + store.string();
    const CommandResult closed = runCommand("(" + by_nobody + " 2>&1)");
    EXPECT_EQ(closed.exit_code, 1);
    EXPECT_THAT(closed.output,
                testing::ContainsRegex("BAD  store +.*: the store cannot be used \\(Permission denied\\)"));
    EXPECT_THAT(closed.output, AllOf(Not(HasSubstr("filesystem error")), Not(HasSubstr("quarantine     empty"))));
    fs::permissions(store, fs::perms::owner_all | fs::perms::others_read | fs::perms::others_exec);
    fs::create_directories(store / "quarantine");
    fs::permissions(store / "quarantine", fs::perms::owner_all);
    EXPECT_THAT(runCommand("(" + by_nobody + " 2>&1)").output,
                testing::ContainsRegex("BAD  quarantine +.*: it cannot be looked at \\(Permission denied\\)"));
}

TEST(Doctor, DoesNotCallAPeerThatOnlyStoresHere)
{
    const TemporaryFolder folder;
    std::ofstream(folder / "c.toml") << "[peers]\nct1 = { host = \"127.0.0.1\", port = 9, roles = [\"store\"] }\n";
    const CommandResult result = doctor(storeIn(folder), "--config " + (folder / "c.toml").string());
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output, testing::ContainsRegex("ok   peer ct1 +ct1 at 127.0.0.1:9 only stores here"));
}

TEST(Doctor, ADatabaseThatIsDownIsOneLineAndLeavesTheRest)
{
    const TemporaryFolder folder;
    fs::create_directories(folder / "store");
    std::ofstream(folder / "store/database.id") << "of a store";
    const CommandResult result = doctor(folder / "store", "--set store.database=postgresql://127.0.0.1:9/none");
    EXPECT_EQ(result.exit_code, 1) << result.output;
    EXPECT_THAT(result.output, HasSubstr("BAD  database"));
    EXPECT_EQ(result.output.find("BAD"), result.output.rfind("BAD")) << result.output;
    EXPECT_THAT(result.output, testing::ContainsRegex("ok   disk space +.*GB free"));
}

TEST(Doctor, FindsADamagedDatabaseAndAPeerThatDoesNotAnswer)
{
    const TemporaryFolder folder;
    const fs::path store = storeIn(folder);
    ASSERT_EQ(doctor(store).exit_code, 0);
    std::fstream file(store / "vicon.db", std::ios::in | std::ios::out | std::ios::binary);
    constexpr long kPage = 4096;
    file.seekp(0, std::ios::end);
    file.seekp(long(file.tellp()) - kPage);
    file << std::string(kPage, 'x');
    file.close();
    std::ofstream(folder / "c.toml") << "[peers]\npacs = { host = \"127.0.0.1\", port = 9 }\n";
    const CommandResult result = doctor(store, "--config " + (folder / "c.toml").string());
    EXPECT_EQ(result.exit_code, 1) << result.output;
    EXPECT_THAT(result.output, testing::ContainsRegex("BAD  database +.*damaged"));
    EXPECT_THAT(result.output, testing::ContainsRegex("BAD  peer pacs +.*no association"));
}

}  // namespace
}  // namespace vicon::support
