// A database that is damaged: one line that says what to do, no patient in it, and nothing that was whole is lost.
#include <gmock/gmock.h>

#include "dicom_writer.h"
#include "running_listener.h"
#include "study.h"
#include "vicon/core/file.h"
#include "vicon/ingest/sender.h"
#include "vicon/support/damaged_table.h"

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class DamagedDatabase : public testing::Test {
protected:
    TemporaryFolder folder_;
    const fs::path store_ = folder_ / "store", backup_ = folder_ / "backup";
    NoProgress quiet_;

    void SetUp() override { viconOn(store_, "import " + study("1").at(0).parent_path().string()); }
    std::vector<fs::path> study(const std::string& name) const
    {
        test::SeriesSpec spec;
        spec.study_uid += "." + name;
        spec.series_uid = spec.study_uid + ".1";
        spec.patient_id = "M-77";
        spec.patient_name = "Mustermann^Erika";
        spec.birth_date = "19500101";
        return test::writeSeries(folder_ / name, spec);
    }
    CommandResult vicon(const std::string& arguments) const
    {
        return runVicon(arguments + " --store " + store_.string());
    }
};

/// Neither the patient nor the statement that failed.
auto namesNobody()
{
    return AllOf(Not(HasSubstr("M-77")), Not(HasSubstr("Mustermann")), Not(HasSubstr("19500101")),
                 Not(HasSubstr("SELECT")), Not(HasSubstr(":pid")));
}

void expectOneLine(const CommandResult& result)
{
    EXPECT_EQ(result.exit_code, 1) << result.output;
    const auto lines = linesWithoutProgress(result.output);
    ASSERT_EQ(lines.size(), 1u) << result.output;
    EXPECT_THAT(lines[0], AllOf(testing::StartsWith("vicon: "), HasSubstr("the database is damaged"),
                                HasSubstr("'vicon restore'"), namesNobody()));
}

TEST_F(DamagedDatabase, IsOneLineThatSaysWhatToDoWhateverIsAsked)
{
    const auto files = study("2");
    const std::string case_id = listedScans(store_).at(0).case_id;
    const DamagedTable damaged(store_, "cases");
    for (const std::string& asked : {std::string("cases"), "show " + case_id, std::string("work --until-idle"),
                                     "import " + files.at(0).parent_path().string(), "backup " + backup_.string()}) {
        SCOPED_TRACE(asked);
        expectOneLine(vicon(asked));
    }
    EXPECT_THAT(vicon("doctor").output, AllOf(HasSubstr("BAD  database"), namesNobody()));
}

TEST_F(DamagedDatabase, FileThatIsNoDatabaseIsToldLikewise)
{
    replaceFile(store_ / "vicon.db", std::string(8192, 'x'));
    expectOneLine(vicon("cases"));
}

TEST_F(DamagedDatabase, DoesNotTakeThePlaceOfAnEarlierBackup)
{
    viconOn(store_, "backup " + backup_.string());
    const auto whole = filesOf(backup_);
    const DamagedTable damaged(store_, "scans");
    expectOneLine(vicon("backup " + backup_.string()));
    EXPECT_EQ(filesOf(backup_), whole);
    viconOn(folder_ / "again", "restore " + backup_.string());
}

using LostDatabase = DamagedDatabase;

/// Neither a check nor a listener nor the next backup makes another one in its place.
TEST_F(LostDatabase, IsSaidWhateverIsAskedAndCostsNoBackup)
{
    viconOn(store_, "backup " + backup_.string());
    const auto files = study("2");
    const auto in_backup = filesOf(backup_);
    for (const bool is_empty : {false, true}) {
        SCOPED_TRACE(is_empty);
        for (const char* name : {"vicon.db", "vicon.db-wal", "vicon.db-shm"})
            fs::remove(store_ / name);
        if (is_empty)
            replaceFile(store_ / "vicon.db", "");
        for (const std::string& asked :
             {std::string("cases"), "backup " + backup_.string(), "import " + files.at(0).parent_path().string(),
              std::string("receive --port 0 --no-work")}) {
            const CommandResult told = vicon(asked);
            EXPECT_EQ(told.exit_code, 1) << asked;
            EXPECT_THAT(told.output, AllOf(HasSubstr("its database is gone or empty"), HasSubstr("'vicon restore'")))
                << asked;
        }
        const CommandResult checked = vicon("doctor");
        EXPECT_EQ(checked.exit_code, 1);
        EXPECT_THAT(checked.output, testing::ContainsRegex("BAD  database +.*its database is gone or empty"));
        EXPECT_TRUE(is_empty || !fs::exists(store_ / "vicon.db"));
        EXPECT_EQ(filesOf(backup_), in_backup);
    }
    EXPECT_EQ(viconJson(folder_ / "again", "restore " + backup_.string())["cases"], 1);
    const fs::path other = folder_ / "other";
    viconOn(other, "import " + files.at(0).parent_path().string());
    const CommandResult refused = runVicon("backup " + backup_.string() + " --store " + other.string());
    EXPECT_EQ(refused.exit_code, 2) << refused.output;
    EXPECT_THAT(refused.output, HasSubstr("holds 1 cases, and this store never had one of them"));
}

using LostObject = DamagedDatabase;

TEST_F(LostObject, DoesNotCostItsCopyWhereItWasChanged)
{
    viconOn(store_, "backup " + backup_.string());
    const ListedScan scan = listedScans(store_).at(0);
    const fs::path object = fs::directory_iterator(scan.folder / "dicom")->path();
    const std::string whole = readFile(object);
    replaceFile(object, whole + "x");
    const CommandResult told = vicon("backup " + backup_.string());
    EXPECT_EQ(told.exit_code, 3) << told.output;
    EXPECT_THAT(told.output, HasSubstr(" is not what it was in the store; its earlier copy stays in the backup\n"));
    EXPECT_EQ(readFile(backup_ / fs::relative(object, store_)), whole);
    EXPECT_EQ(viconJson(folder_ / "again", "restore " + backup_.string())["faults"].size(), 0u);
}

TEST_F(LostObject, IsSaidByBackupAndRestoreWhichGoOnWithTheRest)
{
    const ListedScan scan = listedScans(store_).at(0);
    fs::remove(fs::directory_iterator(scan.folder / "dicom")->path());
    constexpr int kNotWhole = 3;
    for (const std::string& line : {"backup " + backup_.string() + " --store " + store_.string(),
                                    "restore " + backup_.string() + " --store " + (folder_ / "again").string()}) {
        const CommandResult told = runVicon(line);
        EXPECT_EQ(told.exit_code, kNotWhole) << line;
        EXPECT_THAT(told.output, AllOf(HasSubstr("case " + scan.case_id + ": cases/" + scan.case_id),
                                       HasSubstr(".dcm is missing\n"), HasSubstr("not whole: 1 files"), namesNobody()));
    }
    const std::string as_json = viconBinary() + " backup --json " + backup_.string() + " --store " + store_.string();
    expectSchema("backup", nlohmann::json::parse(runCommand("(" + as_json + " 2>/dev/null)").output));
    EXPECT_EQ(schemaFaults("about_backup", {backup_ / "backup.json"}), "");
    EXPECT_EQ(listedScans(folder_ / "again").size(), 1u);
}

TEST_F(DamagedDatabase, CostsTheListenerNothingThatItAcknowledged)
{
    const auto files = study("2");
    RunningListener listener(store_, "--set receive.quiet_s=0");
    const DamagedTable damaged(store_, "cases");
    ASSERT_TRUE(ingest::storeFiles(listener.peer(), files, "SCANNER", quiet_).complete());
    const auto says = [&](const std::string& words) { return listener.log().find(words) != std::string::npos; };
    EXPECT_TRUE(waitUntil([&] { return says("12 received objects could not be taken and wait in incoming: "); }));
    EXPECT_THAT(listener.log(), AllOf(HasSubstr("the database is damaged"), namesNobody()));
    listener.end(SIGTERM);  // it has read the page
    damaged.mend();
    const RunningListener again(store_, "--set receive.quiet_s=0");
    EXPECT_TRUE(waitUntil([&] { return viconJson(store_, "cases")["cases"].size() == 2; })) << again.log();
    EXPECT_FALSE(fs::exists(store_ / "quarantine"));
}

}  // namespace
}  // namespace vicon::support
