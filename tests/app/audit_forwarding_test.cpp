// The audit trail reaches syslog as audit messages: each line once, none lost while syslog is away.
#include "audit_forwarding.h"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <map>
#include <set>

#include "atna_message.h"
#include "operation_audit.h"
#include "vicon/cases/case_deletion.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/support/support.h"

namespace vicon::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Listens as syslog does, for as long as it lives.
class Listening {
public:
    explicit Listening(const fs::path& place) : place_(place), socket_(::socket(AF_UNIX, SOCK_DGRAM, 0))
    {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::strncpy(address.sun_path, place.c_str(), sizeof address.sun_path - 1);
        EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    }
    ~Listening()
    {
        ::close(socket_);
        fs::remove(place_);
    }
    /// What has come.
    std::vector<std::string> packets() const
    {
        std::vector<std::string> all;
        std::string packet(1 << 16, '\0');
        for (ssize_t size; (size = ::recv(socket_, packet.data(), packet.size(), MSG_DONTWAIT)) >= 0;)
            all.push_back(packet.substr(0, std::size_t(size)));
        return all;
    }

private:
    fs::path place_;
    int socket_;
};

class AuditForwarding : public testing::Test {
protected:
    support::TemporaryFolder folder_;
    CaseStore store_{folder_ / "store"};
    const AuditOptions options_{(folder_ / "log").string()};

    void SetUp() override
    {
        CaseRecord a_case{.id = "c1"};
        a_case.patient.id = "4711 <&\">";
        a_case.patient.name = "Doe^Jane";
        a_case.study.uid = "1.2.3";
        ScanRecord scan{.id = "s1", .case_id = "c1"};
        makePrivateFolder(store_.scanFolder("c1", "s1"));
        store_.addScan(a_case, scan, {}, false);
    }
    /// The message within a packet, held against the schema.
    std::string checked(const std::string& packet)
    {
        EXPECT_THAT(packet, testing::StartsWith("<85>1 20"));
        EXPECT_THAT(packet, HasSubstr(" VICON "));
        EXPECT_THAT(packet, HasSubstr(" DICOM+RFC3881 - \xEF\xBB\xBF<"));
        const std::string message = packet.substr(packet.find("\xEF\xBB\xBF") + 3);
        std::ofstream(folder_ / "message.xml") << message;
        const auto judged = support::runCommand("xmllint --noout --relaxng " VICON_ATNA_SCHEMA " " +
                                                (folder_ / "message.xml").string() + " 2>&1");
        EXPECT_EQ(judged.exit_code, 0) << judged.output << message;
        return message;
    }
};

TEST_F(AuditForwarding, SendsEachLineOnce)
{
    const Listening syslog(options_.syslog);
    EXPECT_EQ(forwardAudit(store_, options_), 1);
    const auto packets = syslog.packets();
    ASSERT_EQ(packets.size(), 1u);
    const std::string message = checked(packets[0]);
    EXPECT_THAT(message, HasSubstr(R"(EventActionCode="C")"));
    EXPECT_THAT(message, HasSubstr(R"(csd-code="110104")"));
    EXPECT_THAT(message, HasSubstr(R"(ParticipantObjectID="1.2.3")"));
    EXPECT_THAT(message, HasSubstr("4711 &lt;&amp;&quot;"));
    EXPECT_EQ(forwardAudit(store_, options_), 0);
    store_.audit(AuditEvent::case_deleted, "c0", "", "a case that is gone");
    store_.audit(AuditEvent::case_opened, "c1", "", "");
    EXPECT_EQ(forwardAudit(store_, options_), 2);
    const auto later = syslog.packets();
    ASSERT_EQ(later.size(), 2u);
    EXPECT_THAT(checked(later[0]), HasSubstr(R"(csd-code="110105")"));
    EXPECT_THAT(checked(later[1]), HasSubstr(R"(csd-code="110103")"));
}

TEST_F(AuditForwarding, NamesOfADeletedCaseThePatientAndTheStudyThatItWas)
{
    store_.audit(AuditEvent::case_opened, "c1", "", "");
    NoProgress quiet;
    deleteCase(store_, "c1", true, "deleted by hand", quiet);
    const Listening syslog(options_.syslog);
    EXPECT_EQ(forwardAudit(store_, options_), 3);
    const auto packets = syslog.packets();
    ASSERT_EQ(packets.size(), 3u);
    for (const std::string& packet : packets) {  // also those that were not sent before
        const std::string message = checked(packet);
        EXPECT_THAT(message, HasSubstr(R"(ParticipantObjectID="1.2.3")"));
        EXPECT_THAT(message, HasSubstr(R"(ParticipantObjectID="4711 &lt;&amp;&quot;)"));
        EXPECT_THAT(message, testing::Not(HasSubstr("Doe")));
    }
    EXPECT_THAT(packets[2], HasSubstr(R"(csd-code="110105")"));
}

/// Events of no case, by the codes of PS3.16 CID 400 and 401.
TEST_F(AuditForwarding, SendsWhatIsOfNoCaseByItsOwnCode)
{
    const Listening syslog(options_.syslog);
    forwardAudit(store_, options_);
    ASSERT_EQ(syslog.packets().size(), 1u);
    const std::map<AuditEvent, std::pair<std::string, std::string>> codes = {
        {AuditEvent::application_started, {"110100", "110120"}},
        {AuditEvent::application_stopped, {"110100", "110121"}},
        {AuditEvent::files_imported, {"110107", ""}},
        {AuditEvent::store_restored, {"110107", ""}},
        {AuditEvent::store_backed_up, {"110106", ""}},
        {AuditEvent::peer_asked, {"110112", ""}},
        {AuditEvent::caller_refused, {"110113", "110126"}},
        {AuditEvent::account_refused, {"110113", "110132"}},
    };
    for (const auto& [event, code] : codes) {
        auditOperation(store_.place(), event, "why <so>");
        forwardAudit(store_, options_);
        const auto packets = syslog.packets();
        ASSERT_EQ(packets.size(), 1u) << nameOf(event);
        const std::string message = checked(packets[0]);
        EXPECT_THAT(message, HasSubstr("<EventID csd-code=\"" + code.first + "\"")) << nameOf(event);
        EXPECT_EQ(message.find("<EventTypeCode csd-code=\"" + code.second + "\"") != std::string::npos,
                  !code.second.empty())
            << nameOf(event);
        EXPECT_THAT(message, HasSubstr("why &lt;so&gt;")) << nameOf(event);
        const bool is_alert = code.first == "110113";
        EXPECT_THAT(message, HasSubstr(is_alert ? R"(EventOutcomeIndicator="4")" : R"(EventOutcomeIndicator="0")"));
    }
    for (const AuditEvent event :
         {AuditEvent::report_exported, AuditEvent::picture_saved, AuditEvent::case_written_without_names}) {
        store_.audit(event, "c1", "", "");
        forwardAudit(store_, options_);
        const auto packets = syslog.packets();
        ASSERT_EQ(packets.size(), 1u) << nameOf(event);
        EXPECT_THAT(checked(packets[0]), HasSubstr(R"(<EventID csd-code="110106")")) << nameOf(event);
    }
}

TEST_F(AuditForwarding, TellsWhatAnotherVersionWroteAsAChangeOfTheCase)
{
    const std::string told = atnaMessage({1, "c1", {.at = "2026-01-02T03:04:05Z", .event = "dreamt of"}}, {}, "here");
    EXPECT_THAT(told, HasSubstr(R"(<EventID csd-code="110110")"));
    EXPECT_THAT(told, HasSubstr(R"(type="event" value="ZHJlYW10IG9m")"));
}

TEST_F(AuditForwarding, KeepsALineOfTheRunOfAProgramAndNoneWhereThereIsNoStore)
{
    const long long before = auditAfter(store_, 0, 1000).back().number;
    {
        const AuditedRun run(store_.place(), "receive");
    }
    const auto lines = auditAfter(store_, before, 1000);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0].line.event, "application started");
    EXPECT_EQ(lines[1].line.event, "application stopped");
    EXPECT_EQ(lines[1].line.detail, "receive");
    auditOperation(StorePlace(folder_ / "none"), AuditEvent::peer_asked, "main");
    EXPECT_FALSE(fs::exists(folder_ / "none"));
}

TEST_F(AuditForwarding, KeepsOfACallerThatIsRefusedAgainAndAgainALineAMinute)
{
    const long long before = auditAfter(store_, 0, 1000).back().number;
    std::chrono::steady_clock::time_point now{};
    RefusedCallers refused(store_.place(), [&] { return now; });
    for (int n = 0; n < 500; ++n)
        refused.note("10.1.1.1", "refused 'X' at 10.1.1.1: because");
    refused.note("10.1.1.2", "refused 'Y' at 10.1.1.2: because");
    now += std::chrono::seconds(61);
    refused.note("10.1.1.1", "refused 'Z' at 10.1.1.1: because");
    const auto lines = auditAfter(store_, before, 1000);
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0].line.event, "caller refused");
    EXPECT_EQ(lines[1].line.detail, "refused 'Y' at 10.1.1.2: because");
    EXPECT_EQ(lines[2].line.detail, "refused 'Z' at 10.1.1.1: because; before, 499 more of this host");
}

TEST_F(AuditForwarding, LosesNothingWhileSyslogIsAway)
{
    for (int n = 0; n < 150; ++n)
        store_.audit(AuditEvent::flagged, "c1", "", std::to_string(n));
    EXPECT_THROW(forwardAudit(store_, options_), Error);
    const Listening syslog(options_.syslog);
    std::size_t came = 0;
    // A local socket holds few packets: whoever sends waits until they are read.
    std::jthread reading([&](const std::stop_token& stop) {
        while (!stop.stop_requested())
            came += syslog.packets().size();
    });
    EXPECT_EQ(forwardAudit(store_, options_), 151);
    reading.request_stop();
    reading.join();
    came += syslog.packets().size();
    EXPECT_EQ(came, 151u);
}

/// What a local socket took before it was full was sent: the next try begins behind it.
TEST_F(AuditForwarding, SendsNoLineTwiceToASyslogThatReadsSlowly)
{
    const int held = std::stoi(readFile("/proc/sys/net/unix/max_dgram_qlen"));
    for (int n = 0; n < held + held / 2; ++n)
        store_.audit(AuditEvent::flagged, "c1", "", std::to_string(n));
    const auto all = auditAfter(store_, 0, 10 * held);
    const Listening syslog(options_.syslog);
    EXPECT_THROW(forwardAudit(store_, options_), Error);
    std::vector<std::string> came = syslog.packets();
    EXPECT_GE(int(came.size()), held);
    EXPECT_LT(came.size(), all.size());
    EXPECT_EQ(came.size() + std::size_t(forwardAudit(store_, options_)), all.size());
    std::ranges::copy(syslog.packets(), std::back_inserter(came));
    ASSERT_EQ(came.size(), all.size());
    EXPECT_EQ(std::set<std::string>(came.begin(), came.end()).size(), all.size()) << "each once";
}

TEST_F(AuditForwarding, SaysWhereNobodyListens)
{
    for (const char* nowhere : {"/nonexistent/log", "no port", "no.such.host.invalid:514"})
        try {
            forwardAudit(store_, {nowhere});
            ADD_FAILURE() << nowhere;
        } catch (const Error& e) {
            EXPECT_THAT(e.what(), HasSubstr(nowhere));
        }
}

}  // namespace
}  // namespace vicon::app
