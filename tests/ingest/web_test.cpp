// DICOMweb, with Orthanc's service as the other side.
#include <gmock/gmock.h>
#include <soci/soci.h>

#include <algorithm>
#include <set>

#include "certificates.h"
#include "dicom_writer.h"
#include "multipart.h"
#include "orthanc.h"
#include "store_fixture.h"
#include "vicon/ingest/delivery.h"
#include "vicon/ingest/modality_worklist.h"
#include "vicon/ingest/query.h"
#include "web_peer.h"

namespace vicon::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Uids = std::vector<std::string>;

std::string errorOf(const std::function<void()>& action)
{
    try {
        action();
    } catch (const Error& e) {
        return e.what();
    }
    return "";
}

/// An Orthanc, and two patients' studies.
class Web : public StoreFixture {
protected:
    Orthanc orthanc{folder / "orthanc", 0, {}, withDicomWeb({{"OverwriteInstances", true}})};
    const ingest::Peer peer = orthanc.webPeer();
    SeriesSpec wanted, other;
    std::multiset<std::string> sent;
    std::vector<fs::path> files;

    void SetUp() override
    {
        ASSERT_TRUE(orthanc.answers()) << readFile(folder / "orthanc/log");
        other.study_uid += ".7";
        other.series_uid += ".7";
        other.patient_id = "P2";
        other.patient_name = "Roe^Richard";
        files = writeSeries(folder / "wanted", wanted);
        for (const fs::path& file : files)
            sent.insert(fingerprint(readFile(file)));
    }
    ingest::SendResult store_at_peer(const std::vector<fs::path>& these)
    {
        return ingest::storeFiles(peer, these, "VICON", quiet);
    }
    std::multiset<std::string> filesIn(const fs::path& where)
    {
        std::multiset<std::string> prints;
        for (const auto& entry : fs::directory_iterator(where))
            prints.insert(fingerprint(readFile(entry.path())));
        return prints;
    }
    ingest::RetrieveResult get(const std::set<std::string>& have = {})
    {
        return ingest::getSeries(peer, wanted.study_uid, {wanted.series_uid}, folder / "got", "VICON", quiet, have);
    }
};

TEST_F(Web, FindsWhatItIsAskedFor)
{
    ASSERT_TRUE(store_at_peer(files).complete());
    const auto others = writeSeries(folder / "other", other);
    describe(folder / "other");
    ASSERT_TRUE(store_at_peer(others).complete());
    const auto uidsOf = [&](const ingest::StudyQuery& query) {
        Uids uids;
        for (const auto& study : ingest::findStudies(peer, query, "VICON", quiet))
            uids.push_back(study.study_uid);
        return uids;
    };
    EXPECT_EQ(uidsOf({}).size(), 2U);
    EXPECT_EQ(uidsOf({.patient_id = "P2"}), Uids{other.study_uid});
    EXPECT_EQ(uidsOf({.patient_name = "Doe*"}), Uids{wanted.study_uid});
    EXPECT_EQ(uidsOf({.dates = "2026-01-01-2026-01-03"}).size(), 2U);
    EXPECT_EQ(uidsOf({.dates = "2026-01-03-"}), Uids{});
    EXPECT_EQ(uidsOf({.study_uid = wanted.study_uid}), Uids{wanted.study_uid});
    EXPECT_EQ(uidsOf({.modality = "MR"}), Uids{});
    EXPECT_EQ(uidsOf({.description = "*COLONOGRAPHY"}), Uids{other.study_uid});
    EXPECT_EQ(uidsOf({.series_description = "prone*"}), Uids{other.study_uid});
    const auto study = ingest::findStudies(peer, {.patient_id = "P1"}, "VICON", quiet).at(0);
    EXPECT_EQ(study.patient_name, "Doe^Jane");
    EXPECT_EQ(study.date, "20260102");
    EXPECT_EQ(study.images, wanted.slices);
    EXPECT_EQ(study.modalities, "CT");
    const auto series = ingest::describeSeries(peer, wanted.study_uid, "VICON", quiet);
    ASSERT_EQ(series.size(), 1U);
    EXPECT_EQ(series[0].uid, wanted.series_uid);
    EXPECT_EQ(series[0].modality, "CT");
    EXPECT_EQ(series[0].images, wanted.slices);
    EXPECT_EQ(ingest::findObjects(peer, wanted.study_uid, wanted.series_uid, "VICON", quiet).size(), 12U);
}

TEST_F(Web, StoresAndGivesBackElementByElement)
{
    const auto stored = store_at_peer(files);
    EXPECT_EQ(stored.sent, 12);
    EXPECT_EQ(orthanc.objects(), 12U);
    const auto result = get();
    EXPECT_EQ(result.completed, wanted.slices);
    EXPECT_EQ(result.failed, 0);
    EXPECT_EQ(filesIn(folder / "got"), sent);
    EXPECT_EQ(import({folder / "got"}).scans_stored, 1);
}

TEST_F(Web, EveryEncodingComesAsItIs)
{
    VICON_NEEDS_DATA("dicom/syntaxes");
    std::vector<fs::path> all;
    for (const auto& entry : fs::directory_iterator(support::sharedData("dicom/syntaxes")))
        if (entry.path().extension() == ".dcm")
            all.push_back(entry.path());
    ASSERT_EQ(all.size(), 16U);
    for (const fs::path& file : all) {  // one in place of the other: they have one UID
        const auto stored = store_at_peer({file});
        EXPECT_TRUE(stored.complete()) << file << ": " << stored.failures.at(0).reason;
        EXPECT_EQ(ingest::web::readBack(peer, file, quiet), ingest::web::Kept::whole) << file;
    }
}

TEST_F(Web, GoesOnWhereItStopped)
{
    ASSERT_TRUE(store_at_peer(files).complete());
    ASSERT_EQ(get().completed, wanted.slices);
    std::vector<fs::path> got;
    for (const auto& entry : fs::directory_iterator(folder / "got"))
        got.push_back(entry.path());
    std::sort(got.begin(), got.end());
    for (std::size_t n = 0; n < 5; ++n)
        fs::remove(got[n]);
    EXPECT_EQ(get().completed, 6) << "five, and the one that may have been half there";
    EXPECT_EQ(filesIn(folder / "got"), sent);
    std::set<std::string> all;
    for (int n = 0; n < wanted.slices; ++n)
        all.insert(wanted.sopUid(n));
    EXPECT_EQ(get(all).completed, 0) << "what the store has is not fetched again";
}

TEST_F(Web, IsFetchedWholeOverAConnectionThatBreaks)
{
    ASSERT_TRUE(store_at_peer(files).complete());
    class AfterAFew : public NoProgress {
    public:
        void report(double, std::string_view) override { ++reports; }
        bool cancelled() const override { return reports >= 5; }
        int reports = 0;
    } interrupted;
    EXPECT_THROW(ingest::getSeries(peer, wanted.study_uid, {wanted.series_uid}, folder / "got", "VICON", interrupted),
                 Error);
    const auto there = std::distance(fs::directory_iterator(folder / "got"), fs::directory_iterator());
    EXPECT_GE(there, 5);
    for (const auto& entry : fs::directory_iterator(folder / "got"))
        EXPECT_EQ(entry.path().extension(), ".dcm") << "no half file";
    get();
    EXPECT_EQ(filesIn(folder / "got"), sent);
}

TEST_F(Web, WhatIsRefusedSaysWhy)
{
    std::ofstream(folder / "no.dcm") << std::string(5000, 'x');
    const auto result = store_at_peer({files[0], folder / "no.dcm", files[1]});
    EXPECT_EQ(result.sent, 2) << "the others are taken";
    ASSERT_EQ(result.failures.size(), 1U);
    EXPECT_THAT(result.failures[0].reason, HasSubstr("the peer refused it"));
    ingest::Peer wrong = peer;
    wrong.web->url += "/nowhere";
    EXPECT_THAT(errorOf([&] { ingest::findStudies(wrong, {}, "VICON", quiet); }), HasSubstr("HTTP 404"));
    wrong.web->url = "http://localhost:" + std::to_string(freePort());
    EXPECT_THAT(errorOf([&] { ingest::echo(wrong, "VICON"); }), HasSubstr("cannot be reached"));
    EXPECT_NO_THROW(ingest::echo(peer, "VICON"));
    EXPECT_THAT(errorOf([&] { ingest::moveSeries(peer, "1.2", {"1.3"}, "X", "X", quiet); }), HasSubstr("--method get"));
    EXPECT_THAT(errorOf([&] { ingest::findScheduledSteps(peer, {}, "VICON", quiet); }), HasSubstr("own protocol"));
    EXPECT_THAT(errorOf([&] { ingest::describeSeries(peer, "../../etc", "VICON", quiet); }), HasSubstr("no UID"));
}

TEST_F(Web, WhatItGivesBackAsItWasSentCountsAsCommitted)
{
    import({folder / "wanted"});
    const ScanRecord scan = onlyScan();
    std::vector<OutboxObject> images;
    for (const InstanceRecord& instance : store.instances(scan.case_id, scan.id))
        images.push_back(ingest::outboxObject(store.scanFolder(scan.case_id, scan.id) / "dicom" / instance.file));
    const OutboxOptions options{
        .lease_s = 10, .first_backoff_s = 0, .longest_backoff_s = 0, .commitment_s = 1, .at_once = 5};
    queueObjects(store, scan.case_id, "web", images);
    const ingest::Delivery delivery{
        .options = options, .peer = [&](const std::string&) { return peer; }, .our_ae_title = "VICON"};
    // One was taken, and lost since.
    Outbox outbox(store.database(), options);
    const OutboxItem lost = outbox.claim(thisOwner()).at(0);
    outbox.markStored(lost);
    outbox.postpone(lost, "");
    const auto brief = [&] { return deliveryInBrief(countDeliveries(store, scan.case_id)); };
    EXPECT_TRUE(support::waitUntil([&] {
        ingest::deliverDue(store, delivery, {}, quiet);
        return brief() == "12 committed";
    })) << brief();
    EXPECT_EQ(orthanc.objects(), 12U);
}

TEST_F(Web, WhatItKeepsIsReadBackAndCompared)
{
    using ingest::web::Kept;
    const auto kept = [&] { return ingest::web::readBack(peer, files[0], quiet); };
    EXPECT_EQ(kept(), Kept::missing);
    ASSERT_TRUE(store_at_peer({files[0]}).complete());
    EXPECT_EQ(kept(), Kept::whole);
    SeriesSpec changed = wanted;
    changed.densities = [](Point3) { return 100; };
    ASSERT_TRUE(store_at_peer(writeSeries(folder / "changed", changed, {0})).complete());
    EXPECT_EQ(kept(), Kept::changed);
}

/// As hospitals have it: TLS ends before the archive, with certificates on both sides, and a password is asked for.
class WebByTls : public StoreFixture {
protected:
    std::unique_ptr<Orthanc> orthanc;
    ingest::Peer peer;
    const Certificates certificates{folder.path()};
    const int port = freePort();
    pid_t tunnel = -1;

    std::string path(const std::string& name) { return (folder / name).string(); }
    void startTunnel()
    {
        const std::string web = orthanc->webPeer().web->url;
        const std::string behind = web.substr(web.rfind(':') + 1, web.rfind('/') - web.rfind(':') - 1);
        std::ofstream(folder / "tunnel") << "foreground = yes\npid =\n[web]\naccept = 127.0.0.1:" << port
                                         << "\nconnect = 127.0.0.1:" << behind << "\ncert = " << path("pacs.pem")
                                         << "\nkey = " << path("pacs.key") << "\nCAfile = " << path("ca.pem")
                                         << "\nverifyChain = yes\nrequireCert = yes\n";
        tunnel = ::fork();
        if (tunnel == 0) {
            if (!std::freopen(path("tunnel.log").c_str(), "w", stderr))
                std::_Exit(126);
            ::execlp("stunnel4", "stunnel4", path("tunnel").c_str(), nullptr);
            std::_Exit(127);
        }
    }
    void SetUp() override
    {
        certificates.makeAuthority("ca");
        certificates.makeAuthority("strange_ca");
        certificates.certify("pacs", "ca");
        certificates.certify("vicon", "ca");
        certificates.certify("stranger", "strange_ca");
        orthanc = std::make_unique<Orthanc>(
            folder / "orthanc", 0, std::nullopt,
            withDicomWeb({{"AuthenticationEnabled", true}, {"RegisteredUsers", {{"vicon", "a secret"}}}}));
        ASSERT_TRUE(orthanc->answers()) << readFile(folder / "orthanc/log");
        startTunnel();
        std::ofstream(folder / "password") << "a secret\n";
        fs::permissions(folder / "password", fs::perms::owner_read | fs::perms::owner_write);
        peer.name = "web";
        peer.web = {"https://localhost:" + std::to_string(port) + "/dicom-web", "vicon", path("password")};
        peer.tls = ingest::TlsOptions{path("vicon.pem"), path("vicon.key"), path("ca.pem")};
        ASSERT_TRUE(support::waitUntil([&] { return told([](ingest::Peer&) {}).empty(); }))
            << readFile(folder / "tunnel.log");
    }
    void TearDown() override
    {
        ::kill(tunnel, SIGTERM);
        ::waitpid(tunnel, nullptr, 0);
    }
    std::string told(const std::function<void(ingest::Peer&)>& change)
    {
        ingest::Peer changed = peer;
        change(changed);
        return errorOf([&] { ingest::echo(changed, "VICON"); });
    }
};

TEST_F(WebByTls, StoresQueriesAndFetches)
{
    const SeriesSpec spec;
    ASSERT_TRUE(ingest::storeFiles(peer, writeSeries(folder / "in", spec), "VICON", quiet).complete());
    EXPECT_EQ(ingest::findStudies(peer, {.patient_id = "P1"}, "VICON", quiet).size(), 1U);
    EXPECT_EQ(ingest::getSeries(peer, spec.study_uid, {spec.series_uid}, folder / "got", "VICON", quiet).completed, 12);
}

TEST_F(WebByTls, NeitherSideTrustsAStranger)
{
    EXPECT_THAT(told([&](ingest::Peer& p) { p.tls->trusted = path("strange_ca.pem"); }), HasSubstr("certificate"));
    EXPECT_THAT(told([&](ingest::Peer& p) { p.tls.reset(); }), HasSubstr("certificate"));
    EXPECT_NE(told([&](ingest::Peer& p) {
                  p.tls->certificate = path("stranger.pem");
                  p.tls->key = path("stranger.key");
              }),
              "");
    std::ofstream(folder / "wrong") << "guessed";
    fs::permissions(folder / "wrong", fs::perms::owner_read);
    EXPECT_THAT(told([&](ingest::Peer& p) { p.web->password_file = path("wrong"); }), HasSubstr("HTTP 401"));
    EXPECT_THAT(told([&](ingest::Peer& p) { p.web->user.clear(); }), HasSubstr("HTTP 401"));
    fs::permissions(folder / "password", fs::perms::others_read, fs::perm_options::add);
    EXPECT_THAT(told([](ingest::Peer&) {}), HasSubstr("everybody may read the password"));
}

TEST(WebAccess, IsCheckedBeforeItIsUsed)
{
    const auto wrong = [](const ingest::WebAccess& web, bool by_tls = false) {
        return errorOf([&] { ingest::requireUsable(web, by_tls); });
    };
    EXPECT_EQ(wrong({"https://pacs.example.org/dicom-web", "", ""}), "");
    EXPECT_EQ(wrong({"http://10.0.0.5:8042/dicom-web", "", ""}), "");
    EXPECT_EQ(wrong({"http://localhost:8042/dicom-web", "vicon", "f"}), "");
    EXPECT_THAT(wrong({"http://10.0.0.5/dicom-web", "vicon", "f"}), HasSubstr("unencrypted"));
    EXPECT_THAT(wrong({"https://10.0.0.5/dicom-web", "vicon", ""}), HasSubstr("go together"));
    EXPECT_THAT(wrong({"https://vicon:secret@10.0.0.5/dicom-web", "", ""}), HasSubstr("not given in the URL"));
    EXPECT_THAT(wrong({"http://10.0.0.5/dicom-web", "", ""}, true), HasSubstr("https alone"));
    for (const char* url : {"", "pacs", "ftp://pacs/x", "file:///etc/passwd", "https://pacs/x?y=z"})
        EXPECT_THAT(wrong({url, "", ""}), HasSubstr("no URL of a DICOMweb service")) << url;
}

/// The parts of a body that comes so many bytes at a time; the last one without its end is marked.
std::vector<std::string> partsOf(const std::string& body, std::size_t at_a_time)
{
    std::vector<std::string> parts;
    bool open = false;
    ingest::MultipartReader reader("b",
                                   {[&] {
                                        parts.emplace_back();
                                        open = true;
                                    },
                                    [&](std::string_view bytes) { parts.back() += bytes; }, [&] { open = false; }});
    for (std::size_t from = 0; from < body.size(); from += at_a_time)
        reader.feed(std::string_view(body).substr(from, at_a_time));
    if (open)
        parts.back() += "(no end)";
    if (!reader.complete())
        parts.emplace_back("(not complete)");
    return parts;
}

TEST(Multipart, IsReadHoweverItComes)
{
    const std::string body =
        "a preamble\r\n--b \r\nContent-Type: x\r\n\r\none\r\n--c\r\n\r\n--b\r\n\r\n\r\n--b\r\nA: b\r\n"
        "C: d\r\n\r\n\r\n-\r\n--\r\n--b--\r\nan epilogue\r\n--b\r\n\r\nno part";
    for (std::size_t at_a_time = 1; at_a_time <= body.size(); ++at_a_time)
        EXPECT_THAT(partsOf(body, at_a_time), ElementsAre("one\r\n--c\r\n", "", "\r\n-\r\n--")) << at_a_time;
    EXPECT_THAT(partsOf("--b\r\n\r\nat the very beginning\r\n--b--", 3), ElementsAre("at the very beginning"));
    EXPECT_THAT(partsOf("--b\r\n\r\nhalf", 1), ElementsAre("(no end)", "(not complete)"))
        << "what may be a delimiter is held back";
    EXPECT_THAT(partsOf("", 1), ElementsAre("(not complete)"));
}

TEST(Multipart, ThatIsNoneIsRefused)
{
    EXPECT_THROW(partsOf("--bc\r\n\r\n", 1), Error);
    EXPECT_THROW(partsOf("--b \rx\r\n", 1), Error);
    EXPECT_THROW(partsOf("--b" + std::string(1 << 20, ' '), 1000), Error);
    EXPECT_THROW(partsOf("--b\r\nA: " + std::string(1 << 20, 'x'), 1000), Error);
}

TEST(Multipart, HasTheBoundaryThatItsTypeNames)
{
    using ingest::boundaryOf;
    EXPECT_EQ(boundaryOf("multipart/related; type=\"application/dicom\"; boundary=abc"), "abc");
    EXPECT_EQ(boundaryOf("Multipart/Related;boundary=\"a b;c\"; type=application/dicom"), "a b;c");
    EXPECT_EQ(boundaryOf("application/dicom"), "");
    EXPECT_EQ(boundaryOf("text/plain; boundary=abc"), "");
}

}  // namespace
}  // namespace vicon::test
