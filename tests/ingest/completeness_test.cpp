// When a study that arrives is complete: what its archive says.
#include "vicon/ingest/completeness.h"

#include "dicom_writer.h"
#include "running_receiver.h"
#include "store_fixture.h"

namespace vicon::test {
namespace {

class Complete : public StoreFixture {
protected:
    const int port_ = freePort();
    Orthanc orthanc_{folder / "orthanc", port_};
    const std::vector<fs::path> files_ = writeSeries(folder / "in", {});
    std::vector<std::string> ids_;  ///< of the objects in the archive
    std::unique_ptr<ingest::Completeness> completeness_;
    std::unique_ptr<RunningReceiver> listener_;

    void listen(double incomplete_s)
    {
        ASSERT_TRUE(orthanc_.answers());
        ASSERT_TRUE(ingest::storeFiles(orthanc_.peer(), files_, "VICON", quiet).complete());
        for (const auto& id : nlohmann::json::parse(orthanc_.get("/instances")))
            ids_.push_back(id);
        completeness_ = std::make_unique<ingest::Completeness>(store.folder(), orthanc_.peer(), "VICON");
        ingest::ReceiverOptions options;
        options.port = port_;
        options.incomplete_s = incomplete_s;
        const Surroundings counting{
            .on_quiet = [this](const std::vector<fs::path>& files) { return completeness_->missing(files); }};
        listener_ = std::make_unique<RunningReceiver>(
            store.folder() / "incoming", options,
            [this](const std::vector<fs::path>& files) {
                CaseStore own(store.folder());
                ingest::importPaths(own, files, this->options, quiet);
            },
            std::set<std::string>{}, counting);
    }
    void sendFromArchive(std::size_t from, std::size_t to)
    {
        for (std::size_t n = from; n < to; ++n)
            orthanc_.post("/modalities/vicon/store", ids_.at(n));
    }
};

TEST_F(Complete, AStudyWaitsForWhatItsArchiveHas)
{
    listen(3600);
    sendFromArchive(0, 5);
    EXPECT_TRUE(listener_->tells("waits for 7 objects"));
    sendFromArchive(5, 9);
    EXPECT_TRUE(listener_->tells("waits for 3 objects"));
    EXPECT_EQ(listener_->calls(), 0);
    sendFromArchive(9, 12);
    EXPECT_EQ(listener_->waitFor(12).size(), 12u);
    EXPECT_EQ(listener_->calls(), 1) << "it was handed over once, whole";
    sendFromArchive(0, 1);
    EXPECT_EQ(listener_->waitFor(13).size(), 13u) << "what is in its case counts";
}

TEST_F(Complete, AStudyWaitsForASeriesThatHasNotBegun)
{
    SeriesSpec prone;
    prone.series_uid += ".2";
    prone.patient_position = "HFP";
    listen(3600);
    const std::vector<fs::path> others = writeSeries(folder / "prone", prone);
    ASSERT_TRUE(ingest::storeFiles(orthanc_.peer(), others, "VICON", quiet).complete());
    sendFromArchive(0, 12);
    EXPECT_TRUE(listener_->tells("waits for 12 objects"));
    EXPECT_EQ(listener_->calls(), 0) << "one series is whole, the other has not begun";
    ASSERT_TRUE(ingest::storeFiles(listener_->peer(), others, "SCANNER", quiet).complete());
    EXPECT_EQ(listener_->waitFor(24).size(), 24u);
    EXPECT_EQ(listener_->calls(), 1) << "both were handed over at once";
}

TEST_F(Complete, WhatIsNoImageIsNotWaitedFor)
{
    SeriesSpec other;
    other.series_uid += ".3";
    other.modality = "PT";
    listen(3600);
    ASSERT_TRUE(
        ingest::storeFiles(orthanc_.peer(), writeSeries(folder / "other", other, {0, 1}), "VICON", quiet).complete());
    sendFromArchive(0, 12);
    EXPECT_EQ(listener_->waitFor(12).size(), 12u);
}

TEST_F(Complete, WhatWaitsIsKeptForTheNextRun)
{
    listen(3600);
    sendFromArchive(0, 5);
    EXPECT_TRUE(listener_->tells("waits for 7 objects"));
    listener_->stop();
    EXPECT_EQ(listener_->calls(), 0);
    std::size_t kept = 0;
    for (const auto& entry : fs::recursive_directory_iterator(store.folder() / "incoming"))
        kept += entry.path().extension() == ".dcm" ? 1 : 0;
    EXPECT_EQ(kept, 5u);
}

TEST_F(Complete, WhatNeverComesIsNotWaitedForForEver)
{
    listen(0.5);
    sendFromArchive(0, 5);
    EXPECT_TRUE(listener_->tells("is handed over without 7 objects"));
    EXPECT_EQ(listener_->waitFor(5).size(), 5u);
}

TEST_F(Complete, AnArchiveThatIsOffHoldsNothingUp)
{
    listen(3600);
    orthanc_.end(SIGKILL);
    ASSERT_TRUE(ingest::storeFiles(listener_->peer(), files_, "SCANNER", quiet).complete());
    EXPECT_TRUE(listener_->tells("handed over without being counted"));
    EXPECT_EQ(listener_->waitFor(12).size(), 12u);
}

}  // namespace
}  // namespace vicon::test
