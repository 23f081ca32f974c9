// Storage commitment that VICON gives, and what the peers of the configuration may do.
#include "vicon/ingest/commitment.h"

#include <dcmtk/dcmnet/scu.h>
#include <gmock/gmock.h>

#include <fstream>

#include "dicom_writer.h"
#include "orthanc.h"
#include "running_receiver.h"
#include "store_fixture.h"

namespace vicon::test {
namespace {

using testing::HasSubstr;

class Commitment : public StoreFixture {
protected:
    const int port_ = freePort();
    const fs::path incoming_ = store.folder() / "incoming";
    std::vector<fs::path> files_ = writeSeries(folder / "in", {});
    std::mutex mutex_;
    std::vector<ingest::CommitmentReport> reports_;  ///< that came as to a peer

    static ingest::ObjectName nameOf(int slice) { return {UID_CTImageStorage, SeriesSpec{}.sopUid(slice)}; }
    static std::vector<ingest::ObjectName> allNames()
    {
        std::vector<ingest::ObjectName> names;
        for (int n = 0; n < SeriesSpec{}.slices; ++n)
            names.push_back(nameOf(n));
        return names;
    }
    Surroundings giving(std::vector<ingest::Peer> peers = {})
    {
        return {.peers = std::move(peers), .on_demand = [this](const ingest::CommitmentDemand& demand) {
                    CaseStore own(store.folder());
                    return ingest::commitTo(own, demand, quiet);
                }};
    }
    std::unique_ptr<RunningReceiver> receiver(std::vector<ingest::Peer> peers = {},
                                              ingest::ReceiverOptions options = {})
    {
        options.port = port_;
        const auto take = [this](const std::vector<fs::path>& received) {
            CaseStore own(store.folder());
            ingest::importPaths(own, received, this->options, quiet);
        };
        return std::make_unique<RunningReceiver>(incoming_, options, take, std::set<std::string>{}, giving(peers));
    }
    /// What a peer that takes reports heard.
    std::unique_ptr<RunningReceiver> hearer(int port)
    {
        ingest::ReceiverOptions options;
        options.port = port;
        options.ae_title = "HEARER";
        return std::make_unique<RunningReceiver>(
            folder / "hearer", options, nullptr, std::set<std::string>{},
            Surroundings{.on_commitment = [this](const ingest::CommitmentReport& report) {
                const std::lock_guard lock(mutex_);
                reports_.push_back(report);
            }});
    }
    std::size_t heard()
    {
        const std::lock_guard lock(mutex_);
        return reports_.size();
    }
    std::size_t waitingRequests() const
    {
        std::error_code none;
        return std::size_t(
            std::distance(fs::directory_iterator(store.folder() / "commitments", none), fs::directory_iterator()));
    }
    ingest::Peer vicon() const { return {"vicon", "127.0.0.1", "VICON", port_}; }
    /// Asks and hangs up, as a scanner does.
    void ask(const std::string& title, const std::vector<ingest::ObjectName>& names, const std::string& transaction)
    {
        std::optional<ingest::CommitmentReport> answer;
        EXPECT_EQ(ingest::requestCommitment(vicon(), transaction, names, title, 0, answer),
                  ingest::CommitmentRequest::taken);
    }
};

TEST_F(Commitment, OrthancStoresHereAndIsCommittedTo)
{
    const Orthanc orthanc(folder / "orthanc", port_);
    ASSERT_TRUE(orthanc.answers());
    const auto listener = receiver({orthanc.peer()});
    ASSERT_TRUE(ingest::storeFiles(orthanc.peer(), files_, "VICON", quiet).complete());
    for (const auto& id : nlohmann::json::parse(orthanc.get("/instances")))
        orthanc.post("/modalities/vicon/store", id.get<std::string>());
    ASSERT_EQ(listener->waitFor(files_.size()).size(), files_.size());
    nlohmann::json names = nlohmann::json::array();
    for (const auto& name : allNames())
        names.push_back({name.sop_class, name.sop_uid});
    names.push_back({UID_CTImageStorage, "1.2.3"});
    const auto asked = nlohmann::json::parse(
        orthanc.post("/modalities/vicon/storage-commitment", nlohmann::json{{"DicomInstances", names}}.dump()));
    nlohmann::json answer;
    EXPECT_TRUE(support::waitUntil([&] {
        answer = nlohmann::json::parse(orthanc.get("/storage-commitment/" + asked.at("ID").get<std::string>()));
        return answer.at("Status") != "Pending";
    }));
    EXPECT_EQ(answer.at("Success").size(), files_.size()) << answer;
    ASSERT_EQ(answer.at("Failures").size(), 1u) << answer;
    EXPECT_EQ(answer.at("Failures").at(0).at("SOPInstanceUID"), "1.2.3");
    EXPECT_TRUE(support::waitUntil([&] { return waitingRequests() == 0; }));
}

TEST_F(Commitment, WhoWaitsIsAnsweredOverTheSameAssociation)
{
    import({folder / "in"});
    const auto listener = receiver();
    std::optional<ingest::CommitmentReport> answer;
    ingest::requestCommitment(vicon(), "1.2.840.1", allNames(), "SCANNER", 30, answer);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->transaction_uid, "1.2.840.1");
    EXPECT_EQ(answer->committed.size(), files_.size());
    EXPECT_TRUE(answer->failed.empty());
    EXPECT_TRUE(support::waitUntil([&] { return waitingRequests() == 0; }));
}

TEST_F(Commitment, NamesAnObjectOnceHoweverOftenItIsAskedForIt)
{
    import({folder / "in"});
    const auto listener = receiver();
    std::vector<ingest::ObjectName> names(3, nameOf(2));
    names.push_back(nameOf(4));
    std::optional<ingest::CommitmentReport> answer;
    ingest::requestCommitment(vicon(), "1.2.840.2", names, "SCANNER", 30, answer);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->committed.size(), 2u);
    EXPECT_TRUE(answer->failed.empty());
}

TEST_F(Commitment, OfWhatIsNoUidIsRefusedAndOthersAreServed)
{
    import({folder / "in"});
    const auto listener = receiver();
    std::optional<ingest::CommitmentReport> answer;
    EXPECT_THROW(ingest::requestCommitment(vicon(), "1.2\xff", {nameOf(2)}, "SCANNER", 0, answer), Error);
    EXPECT_THROW(ingest::requestCommitment(vicon(), "1.2", {{UID_CTImageStorage, "1.\xff"}}, "SCANNER", 0, answer),
                 Error);
    EXPECT_EQ(waitingRequests(), 0u);
    ingest::requestCommitment(vicon(), "1.2.840.3", {nameOf(2)}, "SCANNER", 30, answer);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->committed.size(), 1u);
    ingest::requestCommitment(vicon(), "1.2.840.4", {nameOf(2)}, "SCA\xffNER", 0, answer);
    EXPECT_TRUE(support::waitUntil([&] { return waitingRequests() == 1; })) << "kept, though nobody can be told";
}

TEST_F(Commitment, WhatWaitsForTheImportOrLiesInQuarantineIsKept)
{
    SeriesSpec localizer;
    localizer.series_uid += ".5";
    localizer.image_type = "ORIGINAL\\PRIMARY\\LOCALIZER";
    const fs::path no_slice = writeSeries(folder / "scout", localizer, {0}).at(0);
    ingest::ReceiverOptions slow;
    slow.port = port_;
    slow.quiet_s = 3600;
    const ingest::ObjectName scout{UID_CTImageStorage, localizer.sopUid(0)};
    const ingest::CommitmentDemand demand{"1.2", {scout, nameOf(3)}};
    {
        RunningReceiver listener(incoming_, slow, {}, {}, giving());
        ASSERT_TRUE(ingest::storeFiles(vicon(), {no_slice, files_.at(3)}, "S", quiet).complete());
        EXPECT_EQ(ingest::commitTo(store, demand, quiet).committed.size(), 2u) << "it is on the disk, and stays";
        ASSERT_EQ(listener.calls(), 0);
    }
    EXPECT_EQ(ingest::commitTo(store, demand, quiet).committed.size(), 0u) << "the test's receiver threw it away";
    std::atomic<bool> stop = false;
    ingest::ReceiverOptions receive;
    receive.port = port_;
    receive.quiet_s = 0;
    ingest::Receiver importing(receive, incoming_, {[&](const ingest::Receiver::Files& received) {
                                   CaseStore own(store.folder());
                                   return ingest::importPaths(own, received, options, quiet).not_stored;
                               }});
    std::thread thread([&] { importing.run(stop); });
    EXPECT_TRUE(ingest::storeFiles(vicon(), files_, "S", quiet).complete());
    EXPECT_TRUE(ingest::storeFiles(vicon(), {no_slice}, "S", quiet).complete());
    stop = true;
    thread.join();
    EXPECT_EQ(ingest::commitTo(store, demand, quiet).committed.size(), 2u);
}

TEST_F(Commitment, IsNotGivenForWhatIsDamagedOrOfAnotherClass)
{
    import({folder / "in"});
    const ScanRecord scan = onlyScan();
    const auto damaged = store.findInstance(nameOf(3).sop_uid);
    std::ofstream(store.scanFolder(scan.case_id, scan.id) / "dicom" / damaged->file, std::ios::app) << "x";
    const auto report = ingest::commitTo(
        store, {"1.2", {nameOf(3), {UID_MRImageStorage, nameOf(4).sop_uid}, {UID_CTImageStorage, "1.9"}, nameOf(5)}},
        quiet);
    EXPECT_EQ(report.committed.size(), 1u);
    ASSERT_EQ(report.failed.size(), 3u);
    EXPECT_THAT(ingest::textOfFailureReason(report.failed[0].reason), HasSubstr("processing failure"));
    EXPECT_THAT(ingest::textOfFailureReason(report.failed[1].reason), HasSubstr("conflict"));
    EXPECT_THAT(ingest::textOfFailureReason(report.failed[2].reason), HasSubstr("no such object"));
}

TEST_F(Commitment, IsReportedWhenThePeerIsBackAlsoByALaterRun)
{
    import({folder / "in"});
    const int hearer_port = freePort();
    const std::vector<ingest::Peer> peers{{"hearer", "127.0.0.1", "HEARER", hearer_port}};
    {
        const auto listener = receiver(peers);
        ask("HEARER", allNames(), "1.2.840.7");
        EXPECT_TRUE(listener->tells("a commitment was not reported to 'HEARER'"));
    }
    EXPECT_EQ(waitingRequests(), 1u);
    EXPECT_EQ(support::schemaFaults("commitment_demand", support::jsonFilesIn(store.folder() / "commitments")), "");
    const auto listener = receiver(peers);
    EXPECT_TRUE(listener->tells("a commitment was not reported to 'HEARER'"));
    const auto other_side = hearer(hearer_port);
    EXPECT_TRUE(support::waitUntil([&] { return heard() > 0; }));
    EXPECT_EQ(reports_.at(0).transaction_uid, "1.2.840.7");
    EXPECT_EQ(reports_.at(0).committed.size(), files_.size());
    EXPECT_TRUE(support::waitUntil([&] { return waitingRequests() == 0; }));
    EXPECT_EQ(heard(), 1u);
}

TEST_F(Commitment, WhoIsNotInTheConfigurationIsToldOf)
{
    const auto listener = receiver();
    ask("STRANGER", {nameOf(1)}, "1.2.840.8");
    EXPECT_TRUE(listener->tells("'STRANGER' at 127.0.0.1: no peer of this title and host is configured"));
}

class Peers : public Commitment {};

TEST_F(Peers, RolesSayWhatAPeerMayDo)
{
    ingest::Peer archive{"archive", "127.0.0.1", "ARCHIVE", 104};
    archive.stores = false;
    ingest::Peer scanner{"scanner", "127.0.0.1", "SCANNER", 104};
    scanner.is_sent = false;
    const auto listener = receiver({archive, scanner});
    EXPECT_NO_THROW(ingest::echo(vicon(), "ARCHIVE"));
    EXPECT_THROW(ingest::storeFiles(vicon(), files_, "ARCHIVE", quiet), Error);
    EXPECT_EQ(ingest::storeFiles(vicon(), files_, "SCANNER", quiet).sent, 12);
    const ingest::CommitmentReport report{"1.2", {nameOf(1)}, {}};
    EXPECT_THROW(ingest::reportCommitment(vicon(), report, "SCANNER"), Error);
    std::optional<ingest::CommitmentReport> answer;
    EXPECT_EQ(ingest::requestCommitment(vicon(), "1.2", {nameOf(1)}, "ARCHIVE", 0, answer),
              ingest::CommitmentRequest::not_offered);
}

TEST_F(Peers, AreWhoMayCallWhereTheListenerIsOpen)
{
    ingest::ReceiverOptions open;
    open.address = "0.0.0.0";
    EXPECT_THROW(receiver({}, open), Error) << "nobody could call";
    const auto listener = receiver({{"scanner", "localhost", "SCANNER", 104}, {"far", "10.9.8.7", "FAR", 104}}, open);
    EXPECT_NO_THROW(ingest::echo(vicon(), "SCANNER"));
    for (const char* title : {"STRANGER", "FAR"}) {
        const auto asked = support::runCommand("echoscu -aec VICON -aet " + std::string(title) + " 127.0.0.1 " +
                                               std::to_string(port_) + " 2>&1");
        EXPECT_NE(asked.exit_code, 0);
        EXPECT_THAT(asked.output, HasSubstr("Calling AE Title Not Recognized"));
    }
    EXPECT_TRUE(listener->tells("refused 'STRANGER' at 127.0.0.1: receive.allow does not name it"));
    EXPECT_TRUE(listener->tells("refused 'FAR' at 127.0.0.1: receive.allow names this title at another host"));
}

TEST_F(Peers, OneThatOpensTooManyAssociationsKeepsNobodyElseOut)
{
    ingest::Peer greedy{"greedy", "127.0.0.1", "GREEDY", 104};
    greedy.max_associations = 1;
    const auto listener = receiver({greedy});
    DcmSCU open;
    open.setPeerHostName("127.0.0.1");
    open.setPeerAETitle("VICON");
    open.setPeerPort(Uint16(port_));
    open.setAETitle("GREEDY");
    OFList<OFString> syntaxes;
    syntaxes.push_back(UID_LittleEndianImplicitTransferSyntax);
    open.addPresentationContext(UID_VerificationSOPClass, syntaxes);
    ASSERT_TRUE(open.initNetwork().good());
    ASSERT_TRUE(open.negotiateAssociation().good());
    EXPECT_THROW(ingest::echo(vicon(), "GREEDY"), Error);
    EXPECT_NO_THROW(ingest::echo(vicon(), "MODEST"));
}

TEST_F(Peers, AreSlowedDownToWhatIsTakenOfThem)
{
    ingest::Peer slow{"slow", "127.0.0.1", "SLOW", 104};
    slow.mb_per_s = 0.01;  // twelve slices of 1 kB, half a second's at once
    const auto listener = receiver({slow});
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_TRUE(ingest::storeFiles(vicon(), files_, "SLOW", quiet).complete());
    EXPECT_GT(std::chrono::steady_clock::now() - begin, 500ms);
}

TEST_F(Peers, OneWhoseObjectsAreNotTakenMayNotFillTheStore)
{
    ingest::ReceiverOptions options;
    options.max_waiting = 5;
    options.quiet_s = 3600;
    const auto listener = receiver({}, options);
    const auto result = ingest::storeFiles(vicon(), files_, "SCANNER", quiet);
    EXPECT_EQ(result.sent, 5);
    ASSERT_EQ(result.failures.size(), 7u);
    EXPECT_FALSE(result.failures[0].for_good);
    EXPECT_THAT(result.failures[0].reason, HasSubstr("a700"));
    EXPECT_EQ(ingest::storeFiles(vicon(), {files_.back()}, "OTHER", quiet).sent, 1);
}

}  // namespace
}  // namespace vicon::test
