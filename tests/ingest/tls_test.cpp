// DICOM by TLS, with DCMTK's tools and Orthanc as the other side.
#include "vicon/ingest/tls.h"

#include <gmock/gmock.h>

#include "certificates.h"
#include "dicom_writer.h"
#include "orthanc.h"
#include "running_receiver.h"
#include "store_fixture.h"
#include "vicon/core/progress.h"
#include "vicon/ingest/commitment.h"
#include "vicon/ingest/query.h"

namespace vicon::test {
namespace {

using testing::HasSubstr;

class Tls : public StoreFixture {
protected:
    const Certificates certificates{folder.path()};
    const int port_ = freePort();
    const std::vector<fs::path> files_ = writeSeries(folder / "in", {});
    ingest::TlsOptions vicon_ = certified("vicon"), other_ = certified("other");

    ingest::TlsOptions certified(const std::string& name)
    {
        if (!fs::exists(folder / "ca.pem"))
            certificates.makeAuthority("ca");
        certificates.certify(name, "ca");
        return {(folder / (name + ".pem")).string(), (folder / (name + ".key")).string(), (folder / "ca.pem").string()};
    }
    std::unique_ptr<RunningReceiver> receiver(ingest::TlsUse use, std::vector<ingest::Peer> peers = {},
                                              ingest::ReceiverOptions options = {})
    {
        options.port = port_;
        options.tls = use;
        return std::make_unique<RunningReceiver>(folder / "listener", options, nullptr, std::set<std::string>{},
                                                 Surroundings{.peers = std::move(peers), .tls = vicon_});
    }
    ingest::Peer called(const ingest::TlsOptions& by) const
    {
        return {.name = "vicon", .host = "localhost", .ae_title = "VICON", .port = port_, .tls = by};
    }
    /// storescu with these of its TLS options.
    bool stores(const std::string& how)
    {
        return support::runCommand("cd " + folder.path().string() + " && storescu -aec VICON " + how + " localhost " +
                                   std::to_string(port_) + " +sd in 2>&1")
                   .exit_code == 0;
    }
};

TEST_F(Tls, StorescuStoresByItAndOnlyWithATrustedCertificate)
{
    certificates.makeAuthority("stranger_ca");
    certificates.certify("stranger", "stranger_ca");
    const auto listener = receiver(ingest::TlsUse::required);
    EXPECT_TRUE(stores("+tls other.key other.pem +cf ca.pem"));
    EXPECT_EQ(listener->waitFor(files_.size()).size(), files_.size());
    EXPECT_FALSE(stores(""));
    EXPECT_TRUE(listener->tells("127.0.0.1 does not speak TLS"));
    EXPECT_FALSE(stores("+tla +cf ca.pem"));
    EXPECT_TRUE(listener->tells("by TLS: peer did not return a certificate"));
    EXPECT_FALSE(stores("+tls stranger.key stranger.pem +cf ca.pem"));
    EXPECT_TRUE(listener->tells("by TLS: unable to get local issuer certificate"));
    EXPECT_TRUE(stores("+tls other.key other.pem +cf ca.pem")) << "the others are served on";
}

TEST_F(Tls, IsSpokenWithWhoSpeaksItAndByPeersThatMust)
{
    ingest::Peer must{.name = "must", .host = "localhost", .ae_title = "MUST", .port = 104, .tls = vicon_};
    const auto listener = receiver(ingest::TlsUse::offered, {must});
    EXPECT_TRUE(stores("+tls other.key other.pem +cf ca.pem"));
    EXPECT_TRUE(stores(""));
    EXPECT_TRUE(stores("-aet MUST +tls other.key other.pem +cf ca.pem"));
    EXPECT_FALSE(stores("-aet MUST"));
    EXPECT_TRUE(listener->tells("refused 'MUST' at 127.0.0.1: it is configured to speak TLS"));
}

TEST_F(Tls, IsRefusedWhereItIsOff)
{
    const auto listener = receiver(ingest::TlsUse::off);
    EXPECT_FALSE(stores("+tls other.key other.pem +cf ca.pem"));
    EXPECT_TRUE(listener->tells("speaks TLS, which receive.tls does not offer"));
}

TEST_F(Tls, WhoeverIsCalledMustHaveTheName)
{
    const auto listener = receiver(ingest::TlsUse::required);
    EXPECT_NO_THROW(ingest::echo(called(other_), "SENDER"));
    ingest::Peer peer = called(other_);
    peer.host = "127.0.0.1";
    EXPECT_NO_THROW(ingest::echo(peer, "SENDER")) << "an address, as the certificate names it";
    peer.certificate_name = "pacs.example.org";
    EXPECT_THROW(ingest::echo(peer, "SENDER"), Error);
    peer.certificate_name = "";
    EXPECT_NO_THROW(ingest::echo(peer, "SENDER"));
    peer.tls.reset();
    EXPECT_THROW(ingest::echo(peer, "SENDER"), Error);
}

TEST_F(Tls, ReplacedCertificatesAreUsedForTheNextConnection)
{
    const auto listener = receiver(ingest::TlsUse::required);
    ASSERT_NO_THROW(ingest::echo(called(other_), "SENDER"));
    certificates.makeAuthority("new_ca");
    certificates.certify("new", "new_ca");
    certificates.certify("new_other", "new_ca");
    const ingest::TlsOptions now{(folder / "new_other.pem").string(), (folder / "new_other.key").string(),
                                 (folder / "new_ca.pem").string()};
    EXPECT_THROW(ingest::echo(called(now), "SENDER"), Error);
    certificates.shell("cp new.pem vicon.pem");
    EXPECT_NO_THROW(ingest::echo(called(other_), "SENDER")) << "until the key has come as well, the ones before serve";
    EXPECT_TRUE(listener->tells("certificates before are used on"));
    certificates.shell("cp new.key vicon.key && cp new_ca.pem ca.pem");
    EXPECT_NO_THROW(ingest::echo(called(now), "SENDER"));
}

TEST_F(Tls, HalfAHandshakeKeepsNobodyWaiting)
{
    ingest::ReceiverOptions options;
    options.request_s = 2;
    const auto listener = receiver(ingest::TlsUse::required, {}, options);
    for (int n = 0; n < 3; ++n) {
        const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_port = htons(std::uint16_t(port_));
        to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        ASSERT_EQ(::connect(socket, reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
        const std::string hello{"\x16\x03\x01\x02\x00\x01\x00", 7};
        ASSERT_EQ(::send(socket, hello.data(), hello.size(), MSG_NOSIGNAL), ssize_t(hello.size()));
        EXPECT_NO_THROW(ingest::echo(called(other_), "SENDER"));
        if (n == 2) {
            EXPECT_TRUE(listener->tells("made no association request in time"));
        }
        ::close(socket);
    }
}

TEST_F(Tls, WrongFilesAreSaid)
{
    for (const auto& [option, words] : {std::pair(&ingest::TlsOptions::certificate, "no certificate can be read"),
                                        std::pair(&ingest::TlsOptions::key, "no key without a password"),
                                        std::pair(&ingest::TlsOptions::trusted, "no certificates can be read")}) {
        ingest::TlsOptions wrong = other_;
        wrong.*option = (folder / "nowhere.pem").string();
        try {
            ingest::echo(called(wrong), "SENDER");
            ADD_FAILURE() << words;
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::wrong_use);
            EXPECT_THAT(e.what(), HasSubstr(words));
        }
    }
    ingest::TlsOptions mixed = other_;
    mixed.key = vicon_.key;
    EXPECT_THROW(ingest::echo(called(mixed), "SENDER"), Error);
}

TEST_F(Tls, CertificatesSayWhenTheyEnd)
{
    certificates.certify("old", "ca", "3");
    const auto terms = ingest::certificateTerms({(folder / "old.pem").string(), "", (folder / "ca.pem").string()});
    ASSERT_EQ(terms.size(), 2u);
    EXPECT_THAT(terms[0].days_left, testing::AllOf(testing::Ge(2), testing::Le(3)));
    EXPECT_THAT(terms[1].days_left, testing::AllOf(testing::Ge(89), testing::Le(90)));
    EXPECT_EQ(terms[0].ends.size(), 10u);
    EXPECT_THROW(ingest::certificateTerms({(folder / "in/0.dcm").string(), "", (folder / "ca.pem").string()}), Error);
}

/// Everything that is done with a PACS, by TLS.
TEST_F(Tls, OrthancIsSentToAskedFetchedFromAndCommits)
{
    const Orthanc orthanc(folder / "orthanc", port_, {{other_, vicon_}});
    ASSERT_TRUE(orthanc.answers()) << readFile(folder / "orthanc/log");
    std::mutex mutex;
    std::vector<ingest::CommitmentReport> reports;
    ingest::ReceiverOptions options;
    options.port = port_;
    options.tls = ingest::TlsUse::required;
    RunningReceiver listener(
        store.folder() / "incoming", options, nullptr, {},
        {.peers = {orthanc.peer()},
         .tls = vicon_,
         .on_demand =
             [&](const ingest::CommitmentDemand& demand) { return ingest::commitTo(store, demand, NoProgress()); },
         .on_commitment =
             [&](const ingest::CommitmentReport& report) {
                 const std::lock_guard lock(mutex);
                 reports.push_back(report);
             }});
    const ingest::Peer peer = orthanc.peer();
    ASSERT_TRUE(ingest::storeFiles(peer, files_, "VICON", quiet).complete());
    EXPECT_EQ(ingest::findStudies(peer, {.patient_id = "P1"}, "VICON", quiet).size(), 1u);
    const SeriesSpec series;
    EXPECT_EQ(ingest::getSeries(peer, series.study_uid, {series.series_uid}, folder / "got", "VICON", quiet).completed,
              series.slices);
    EXPECT_EQ(ingest::moveSeries(peer, series.study_uid, {series.series_uid}, "VICON", "VICON", quiet).completed,
              series.slices);
    EXPECT_EQ(listener.waitFor(files_.size()).size(), files_.size());
    std::optional<ingest::CommitmentReport> answer;
    const ingest::ObjectName first{UID_CTImageStorage, series.sopUid(0)};
    ASSERT_EQ(ingest::requestCommitment(peer, "1.2.840.9", {first}, "VICON", 0, answer),
              ingest::CommitmentRequest::taken);
    EXPECT_TRUE(support::waitUntil([&] {
        const std::lock_guard lock(mutex);
        return !reports.empty();
    }));
    const auto unknown = nlohmann::json::array({first.sop_class, "1.2.3"});
    const auto asked = nlohmann::json::parse(
        orthanc.post("/modalities/vicon/storage-commitment",
                     nlohmann::json{{"DicomInstances", nlohmann::json::array({unknown})}}.dump()));
    EXPECT_TRUE(support::waitUntil([&] {
        return nlohmann::json::parse(orthanc.get("/storage-commitment/" + asked.at("ID").get<std::string>()))
                   .at("Status") == "Failure";
    })) << "it is told that the object is not here";
    EXPECT_EQ(reports.at(0).committed.size(), 1u);
}

}  // namespace
}  // namespace vicon::test
