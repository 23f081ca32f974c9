// What whoever runs VICON does and sees: deleting, backing up, figures and the log, by the command.
#include <gmock/gmock.h>

#include <chrono>
#include <fstream>

#include "delivering_listener.h"
#include "dicom_writer.h"
#include "running_listener.h"
#include "study.h"
#include "vicon/cases/audit_trail.h"
#include "vicon/cases/roles.h"
#include "vicon/core/file.h"
#include "vicon/ingest/sender.h"

namespace vicon::support {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Operation : public testing::Test {
protected:
    TemporaryFolder folder_;
    const fs::path store_ = folder_ / "store";
    std::string case_id_;

    void SetUp() override
    {
        viconOn(store_, "import " + smallStudy().string());
        case_id_ = listedScans(store_).at(0).case_id;
    }
    CommandResult vicon(const std::string& arguments, const fs::path& store) const
    {
        return runVicon(arguments + " --store " + store.string());
    }
    /// What Prometheus gets at a port; empty while nobody answers there.
    static std::string figuresAt(int port)
    {
        const CommandResult got = runCommand(
            "python3 -c 'import urllib.request; print(urllib.request.urlopen("
            "\"http://127.0.0.1:" +
            std::to_string(port) + "/metrics\").read().decode())' 2>&1");
        return got.exit_code == 0 ? got.output : "";
    }
    bool isThere() { return !viconJson(store_, "cases")["cases"].empty(); }
};

TEST_F(Operation, DeletesACaseOnlyWhenToldTwice)
{
    EXPECT_THAT(viconOn(store_, "delete " + case_id_), HasSubstr("nothing was deleted; --yes deletes it\n"));
    EXPECT_TRUE(isThere());
    viconOn(store_, "assess " + case_id_ + " --c-rads C1 --why test");
    EXPECT_THAT(viconOn(store_, "delete " + case_id_),
                testing::AllOf(HasSubstr("! it was read, and its report is not signed"),
                               HasSubstr("nothing was deleted; --yes --lose deletes it\n")));
    const CommandResult refused = vicon("delete " + case_id_ + " --yes", store_);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.output, HasSubstr("--lose deletes it all the same"));
    EXPECT_TRUE(isThere());
    EXPECT_THAT(viconOn(store_, "delete " + case_id_ + " --yes --lose"), HasSubstr("deleted"));
    EXPECT_FALSE(isThere());
    EXPECT_FALSE(fs::exists(store_ / "cases" / case_id_));
    EXPECT_EQ(viconJson(store_, "audit " + case_id_)["trail"].back()["event"], "case deleted");
    viconOn(store_, "import " + smallStudy().string());
    EXPECT_TRUE(isThere()) << "what was deleted can come again";
}

/// A slip of the hand must not hit another patient.
TEST_F(Operation, TakesTheWholeIdOfACaseToChangeIt)
{
    const std::string begun = case_id_.substr(0, 4);
    const auto line = "vicon: '" + begun +
                      "': the beginning of an id is not enough to change or send a case; type all of it: " + case_id_ +
                      "\n";
    for (const char* act :
         {"delete ? --yes --lose", "sign ?", "sign ? --preliminary", "amend ? --reason why", "mark ? --at 0,0,0",
          "markers ? --remove m1", "finding ? --add m1", "assess ? --c-rads C1 --why test", "match ? --confirm m1=m2",
          "priors ? --confirm f1=1.1", "show ? --settle 1", "send ? main --later", "outbox ? --retry-refused",
          "import --mask ? s none", "work --until-idle --case ? --redo-outdated", "work --until-idle --first ?",
          "work --until-idle --case ? --organ airway", "work --until-idle --case ? --forget-corrections"}) {
        std::string with = act;
        with.replace(with.find('?'), 1, begun);
        const CommandResult refused = vicon(with, store_);
        EXPECT_EQ(refused.exit_code, 2) << act;
        EXPECT_THAT(linesWithoutProgress(refused.output), testing::ElementsAre(line.substr(0, line.size() - 1))) << act;
    }
    for (const char* look : {"show ", "finding ", "assess ", "markers ", "outbox ", "audit "})
        EXPECT_EQ(vicon(look + begun, store_).exit_code, 0) << look;
    EXPECT_EQ(viconJson(store_, "audit " + case_id_)["trail"].size(), 1u) << "nothing but the import";
}

TEST_F(Operation, PurgesByRuleAndSaysFirst)
{
    const CommandResult no_rule = vicon("purge", store_);
    EXPECT_EQ(no_rule.exit_code, 2);
    EXPECT_THAT(no_rule.output, HasSubstr("purge.after_days"));
    const std::string everything = " --set purge.least_free_gb=1000000 --set purge.also_unread=true";
    EXPECT_THAT(viconOn(store_, "purge --set purge.least_free_gb=1000000"), HasSubstr("stays: nobody read it"));
    EXPECT_THAT(viconOn(store_, "purge" + everything), HasSubstr("1 cases, 0.0 GB would be deleted"));
    EXPECT_TRUE(isThere());
    EXPECT_TRUE(viconJson(store_, "purge" + everything + " --yes")["cases"][0]["deleted"]);
    EXPECT_FALSE(isThere());
}

TEST_F(Operation, BacksUpAndRestores)
{
    const fs::path backup = folder_ / "backup", again = folder_ / "again";
    viconOn(store_, "backup " + backup.string());
    EXPECT_EQ(viconJson(store_, "backup " + backup.string() + "/")["copied"], 0);
    EXPECT_EQ(vicon("restore " + backup.string(), store_).exit_code, 2) << "not over a store";
    EXPECT_EQ(schemaFaults("about_backup", {backup / "backup.json"}), "");
    viconJson(again, "restore " + backup.string());
    EXPECT_EQ(filesOf(again), filesOf(store_));
    EXPECT_EQ(viconJson(again, "cases")["cases"][0]["patient"], viconJson(store_, "cases")["cases"][0]["patient"]);
}

TEST_F(Operation, GivesFiguresToPrometheusOnLoopback)
{
    const int port = test::freePort();
    replaceFile(folder_ / "c.toml", deliveringConfig(test::freePort(), test::freePort()) +
                                        "[metrics]\nport = " + std::to_string(port) + "\n");
    const DeliveringListener listener(store_, folder_ / "c.toml");
    std::string figures;
    EXPECT_TRUE(waitUntil([&] { return !(figures = figuresAt(port)).empty(); }));
    EXPECT_THAT(figures, HasSubstr("vicon_jobs{state=\"queued\"} 1"));
    EXPECT_THAT(figures, HasSubstr("vicon_instances 134"));
    EXPECT_THAT(figures, HasSubstr("vicon_outbox_objects{state=\"refused\"} 0"));
    EXPECT_THAT(figures, HasSubstr("vicon_quarantine_objects 0"));
    EXPECT_THAT(figures, HasSubstr("vicon_received_associations_total{answer=\"refused\"} 0"));
    EXPECT_THAT(figures, HasSubstr("vicon_received_objects_total{answer=\"accepted\"} 0"));
    EXPECT_THAT(figures, HasSubstr("vicon_received_last_object_timestamp_seconds 0"));
    const auto dashboard = nlohmann::json::parse(readFile(VICON_DEPLOY "/prometheus/dashboard.json"));
    for (const auto& panel : dashboard["panels"])
        for (const auto& target : panel["targets"]) {
            const std::string query = target["expr"];
            const auto from = query.find("vicon_"), to = query.find_first_of("{[ )", from);
            std::string name = query.substr(from, to - from);
            if (name.ends_with("_sum"))  // no step was done yet
                name = "TYPE " + name.substr(0, name.size() - 4);
            EXPECT_THAT(figures, HasSubstr(name)) << panel["title"];
        }
    EXPECT_THAT(runVicon("receive --no-work --port 0 --set metrics.port=" + std::to_string(port) + " --store " +
                         store_.string())
                    .output,
                HasSubstr("the port is taken"));
}

TEST_F(Operation, TellsPrometheusWhereItsStoreIsGone)
{
    const int port = test::freePort();
    const RunningListener listener(store_, "--set metrics.port=" + std::to_string(port));
    EXPECT_TRUE(waitUntil([&] { return figuresAt(port).find("\nvicon_up 1") != std::string::npos; }));
    fs::rename(store_, folder_ / "elsewhere");
    const std::string gone = figuresAt(port);
    EXPECT_THAT(gone, HasSubstr("\nvicon_up 0"));
    EXPECT_THAT(gone, testing::Not(HasSubstr("vicon_cases")));
    EXPECT_FALSE(fs::exists(store_)) << "asking makes none";
    fs::rename(folder_ / "elsewhere", store_);
    EXPECT_THAT(figuresAt(port), testing::AllOf(HasSubstr("\nvicon_up 1"), HasSubstr("vicon_cases 1")));
}

TEST_F(Operation, CountsWhatLiesInQuarantineAndSinceWhen)
{
    EXPECT_THAT(vicon("doctor", store_).output, HasSubstr("quarantine     empty"));
    for (const char* name : {"received/20260102/a.dcm", "c1/somebody/b.dcm"}) {
        fs::create_directories((store_ / "quarantine" / name).parent_path());
        replaceFile(store_ / "quarantine" / name, "an object");
    }
    fs::last_write_time(store_ / "quarantine/c1/somebody/b.dcm",
                        std::chrono::file_clock::from_sys(
                            std::chrono::sys_seconds(std::chrono::sys_days(std::chrono::year(2026) / 1 / 2))));
    EXPECT_THAT(vicon("doctor", store_).output, HasSubstr("quarantine     2 objects since 2026-01-02, in "));
}

TEST_F(Operation, TakesAFlagAwayThatAPersonHasDecided)
{
    test::SeriesSpec other;  // another person of the same patient ID
    other.patient_id = viconJson(store_, "cases")["cases"][0]["patient"]["id"];
    test::writeSeries(folder_ / "other", other);
    viconOn(store_, "import " + (folder_ / "other").string());
    const std::string flag = viconJson(store_, "show " + case_id_)["flags"].at(0);
    EXPECT_THAT(viconOn(store_, "show " + case_id_), HasSubstr("\n! " + flag + "\n"));
    EXPECT_EQ(vicon("show " + case_id_ + " --settle 2", store_).exit_code, 2);
    EXPECT_THAT(viconOn(store_, "show " + case_id_ + " --settle 1"), HasSubstr("settled: " + flag));
    EXPECT_TRUE(viconJson(store_, "show " + case_id_)["flags"].empty());
    EXPECT_EQ(viconJson(store_, "audit " + case_id_)["trail"].back()["event"], "flag settled");
    viconOn(store_, "import " + (folder_ / "other").string());
    EXPECT_TRUE(viconJson(store_, "show " + case_id_)["flags"].empty()) << "it does not come back";
}

TEST_F(Operation, LogsOneLineOfJsonAnEventWithoutThePatient)
{
    const fs::path fresh = folder_ / "fresh" / "store";
    const int port = test::freePort();
    fs::create_directories(fresh.parent_path());
    replaceFile(folder_ / "c.toml", deliveringConfig(port, test::freePort()) + "[log]\nformat = \"json\"\n");
    {
        const DeliveringListener listener(fresh, folder_ / "c.toml");
        EXPECT_TRUE(waitUntil([&] {
            return runCommand("dcmsend -q -aet ORTHANC -aec VICON +sd +r 127.0.0.1 " + std::to_string(port) + " " +
                              (smallStudy() / "series-2-supine").string())
                       .exit_code == 0;
        }));
        EXPECT_TRUE(waitUntil([&] { return !viconJson(fresh, "cases")["cases"].empty(); }));
    }
    const nlohmann::json patient = viconJson(store_, "cases")["cases"][0]["patient"];
    std::ifstream log(fresh.parent_path() / "listener.log");
    std::vector<fs::path> lines;
    for (std::string line; std::getline(log, line);) {
        lines.push_back(folder_ / ("line" + std::to_string(lines.size())));
        replaceFile(lines.back(), line);
        for (const char* key : {"name", "id"})
            EXPECT_THAT(line, testing::Not(HasSubstr(patient[key].get<std::string>())));
    }
    EXPECT_GE(lines.size(), 2u) << "the association, and the study";
    EXPECT_EQ(schemaFaults("log_line", lines), "");
}

TEST_F(Operation, IsNotForThoseWhomTheRolesDoNotName)
{
    const std::string nobody =
        " --set roles.read=nobody_else --set roles.mark=nobody_else --set "
        "roles.operate=nobody_else --set roles.sign=nobody_else";
    const fs::path out = folder_ / "out";
    const std::map<std::string, std::string> acts = {
        {"cases", "may not look at cases"},
        {"show " + case_id_, "may not look at cases"},
        {"report " + case_id_, "may not look at cases"},
        {"mark " + case_id_ + " --at 0,0,0", "may not mark or assess"},
        {"assess " + case_id_ + " --c-rads C1 --why test", "may not look at cases"},
        {"finding " + case_id_, "may not look at cases"},
        {"work --until-idle", "may not do this"},
        {"import " + smallStudy().string(), "may not do this"},
        {"delete " + case_id_ + " --yes", "may not do this"},
        {"backup " + out.string(), "may not do this"},
        {"anonymise " + case_id_ + " " + out.string(), "may not do this"},
        {"receive --port 0", "may not do this"},
    };
    for (const auto& [act, words] : acts) {
        const CommandResult refused = vicon(act + nobody, store_);
        EXPECT_EQ(refused.exit_code, 1) << act;
        EXPECT_THAT(refused.output, HasSubstr(words)) << act;
    }
    const CommandResult unsigned_ = vicon("sign " + case_id_ + " --set roles.sign=nobody_else", store_);
    EXPECT_THAT(unsigned_.output, HasSubstr("may not sign reports"));
    EXPECT_FALSE(fs::exists(out));
    EXPECT_EQ(vicon("config" + nobody, store_).exit_code, 0) << "anybody may ask what the rules are";
}

TEST_F(Operation, ListsFindingsForThoseWhoMayLookAndChangesThemForThoseWhoMayMark)
{
    const std::string reader = " --set roles.mark=nobody_else";
    for (const char* list : {"finding ", "assess "})
        EXPECT_EQ(vicon(list + case_id_ + reader, store_).exit_code, 0) << list;
    for (const auto& [act, more] : {std::pair("finding ", " --add m1"), {"assess ", " --c-rads C1 --why test"}}) {
        const CommandResult refused = vicon(act + case_id_ + more + reader, store_);
        EXPECT_EQ(refused.exit_code, 1) << act;
        EXPECT_THAT(refused.output, HasSubstr("may not mark or assess")) << act;
    }
}

TEST_F(Operation, LetsTheAccountOfTheShippedUnitsWorkWhateverTheRoles)
{
    int units = 0;
    for (const auto& unit : fs::directory_iterator(VICON_DEPLOY "/systemd")) {
        if (unit.path().extension() != ".service")
            continue;
        const std::string text = readFile(unit.path()), key = "\nUser=";
        const auto from = text.find(key) + key.size();
        const std::string account = text.substr(from, text.find('\n', from) - from);
        EXPECT_TRUE(hasRole(account, Role::operate, {.operate = {"nobody_else"}})) << unit.path();
        ++units;
    }
    EXPECT_EQ(units, 2);
}

/// As where its disk is not mounted: its folder is there, and empty.
TEST_F(Operation, MakesNoStoreWhereItsOwnIsGoneAndGoesOnWhenItIsBack)
{
    const int figures = test::freePort();
    RunningListener listener(store_, "--set receive.quiet_s=0 --set metrics.port=" + std::to_string(figures));
    test::SeriesSpec spec;
    spec.study_uid += ".7";
    spec.series_uid += ".7";
    const auto files = test::writeSeries(folder_ / "late", spec);
    NoProgress quiet;
    fs::rename(store_, folder_ / "elsewhere");
    fs::create_directory(store_);
    EXPECT_TRUE(waitUntil([&] { return listener.log().find("the outbox waits: ") != std::string::npos; }));
    const auto refused = ingest::storeFiles(listener.peer(), files, "SCANNER", quiet);
    EXPECT_FALSE(refused.complete());
    EXPECT_THAT(listener.log(), HasSubstr("was refused: the store is gone"));
    EXPECT_TRUE(fs::is_empty(store_)) << "nothing is made in its place";
    fs::remove(store_);
    fs::rename(folder_ / "elsewhere", store_);
    EXPECT_TRUE(ingest::storeFiles(listener.peer(), files, "SCANNER", quiet).complete());
    EXPECT_TRUE(waitUntil([&] { return viconJson(store_, "cases")["cases"].size() == 2; })) << listener.log();
}

/// What is done beside cases, and what is refused.
TEST_F(Operation, LeavesALineOfWhatIsOfNoCase)
{
    std::ofstream(folder_ / "c.toml") << "[peers]\nmain = { host = \"127.0.0.1\", port = 1 }\n";
    vicon("query main --config " + (folder_ / "c.toml").string(), store_);
    vicon("delete " + case_id_ + " --yes --set roles.operate=nobody_else", store_);
    vicon("sign " + case_id_ + " --set roles.sign=nobody_else", store_);
    viconOn(store_, "backup " + (folder_ / "backup").string());
    viconOn(folder_ / "again", "restore " + (folder_ / "backup").string());
    viconOn(store_, "export " + case_id_ + " --as text");
    {
        const RunningListener listener(store_, "--set receive.allow=SOMEBODY");
        EXPECT_NE(runCommand("echoscu -aec VICON 127.0.0.1 " + std::to_string(listener.peer().port)).exit_code, 0);
        EXPECT_TRUE(waitUntil([&] { return listener.log().find("refused 'ECHOSCU'") != std::string::npos; }));
    }
    std::vector<std::string> all;
    for (const fs::path& store : {store_, folder_ / "again"}) {
        CaseStore own(store);
        for (const NumberedAuditLine& one : auditAfter(own, 0, 1000))
            all.push_back(one.line.event + ": " + one.line.detail);
    }
    for (const char* line : {"files imported: 1 scans new or grown", "account refused: may not do this",
                             "account refused: may not sign reports", "store backed up: 1 cases",
                             "store restored: 1 cases", "peer asked: main for studies", "report exported: text",
                             "application started: receive", "application stopped: receive",
                             "caller refused: refused 'ECHOSCU' at 127.0.0.1: receive.allow does not name it"})
        EXPECT_THAT(all, testing::Contains(line));
}

TEST_F(Operation, WritesACaseWithoutNames)
{
    const fs::path out = folder_ / "out";
    EXPECT_THAT(viconOn(store_, "anonymise " + case_id_ + " " + out.string()), HasSubstr("134 objects written"));
    const fs::path other = folder_ / "other";
    viconOn(other, "import " + out.string());
    EXPECT_THAT(viconJson(other, "cases")["cases"][0]["patient"]["name"].get<std::string>(),
                testing::StartsWith("anon-"));
    EXPECT_EQ(vicon("anonymise " + case_id_ + " " + out.string(), store_).exit_code, 2) << "not into what is there";
}

}  // namespace
}  // namespace vicon::support
