// The whole way, with real mouse and key events: from the worklist to what the archive keeps, amended, and back again.
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <optional>

#include "delivering_listener.h"
#include "orthanc.h"
#include "study_walk.h"

namespace vicon::viewer::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kPatience_ms = 300000;  // more than a gigabyte to read, beside whatever else the machine does

/// With an archive that is not ours, to which the outbox delivers.
class WholeWay : public StudyWalk {
protected:
    /// @param source what is imported, once
    void open(const std::string& name, const std::string& store, const fs::path& source)
    {
        patience_ms = kPatience_ms;
        const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
        const fs::path copy = preparedStore(store, source, *folder_ / test), config = *folder_ / (test + ".toml");
        const int port = vicon::test::freePort();
        archive_.emplace(*folder_ / (test + "-orthanc"), port);
        ASSERT_TRUE(archive_->answers());
        replaceFile(config, support::deliveringConfig(port, archive_->peer().port));
        openStore(copy, name, config);
        listener_.emplace(copy, config);
        screenshot("worklist");
        openCase(patient_id_.c_str());
        screenshot("opened");
    }
    void TearDown() override
    {
        StudyWalk::TearDown();
        listener_.reset();
        archive_.reset();
    }

    /// The archive's objects of a modality, as it tells of them.
    std::vector<json> kept(const std::string& modality) const
    {
        std::vector<json> all;
        const json query = {{"Level", "Instance"}, {"Query", {{"Modality", modality}, {"PatientID", patient_id_}}}};
        for (const json& id : json::parse(archive_->post("/tools/find", query.dump())))
            all.push_back(json::parse(archive_->get("/instances/" + id.get<std::string>() + "/simplified-tags")));
        return all;
    }
    /// The PDF, as whoever looks into the archive gets it.
    void expectPdfIsShown() const
    {
        const json query = {{"Level", "Instance"}, {"Query", {{"Modality", "DOC"}}}};
        const json ids = json::parse(archive_->post("/tools/find", query.dump()));
        ASSERT_FALSE(ids.empty());
        const std::string pdf = archive_->get("/instances/" + ids[0].get<std::string>() + "/pdf");
        EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
    }
    void expectInArchive(std::size_t pictures) const
    {
        EXPECT_EQ(kept("DOC").size(), 1U);
        EXPECT_EQ(kept("SR").size(), 1U);
        EXPECT_EQ(kept("KO").size(), 1U);
        EXPECT_GE(kept("SEG").size(), 1U);
        EXPECT_EQ(kept("OT").size(), pictures);
        for (const json& report : kept("SR"))
            EXPECT_EQ(report.value("CompletionFlag", ""), "COMPLETE");
        expectPdfIsShown();
    }
    void expectAmendedInArchive() const
    {
        const std::vector<json> reports = kept("SR");
        ASSERT_EQ(reports.size(), 2U);
        int amendments = 0;
        for (const json& report : reports)
            amendments += report.contains("PredecessorDocumentsSequence") ? 1 : 0;
        EXPECT_EQ(amendments, 1) << "the later one names the earlier one";
    }
    void signSendFindAmend(int findings, int pictures)
    {
        ASSERT_NO_FATAL_FAILURE(signReport(findings));
        const int objects = 3 + scans() + pictures;  // PDF, SR, key images, lumens
        ASSERT_NO_FATAL_FAILURE(awaitArchive(objects));
        expectInArchive(std::size_t(pictures));
        ASSERT_NO_FATAL_FAILURE(amendReport());
        ASSERT_NO_FATAL_FAILURE(awaitArchive(2 * objects));
        expectAmendedInArchive();
        key(Qt::Key_R, Qt::ControlModifier);
    }
    int scans() const { return the<QComboBox>("scan")->count(); }

    std::optional<vicon::test::Orthanc> archive_;
    std::optional<support::DeliveringListener> listener_;
};

class RealScan : public WholeWay {
protected:
    void openScan() { open("scan", "ctc-prone", support::sharedData("ctc-prone")); }
};

TEST_F(RealScan, IsFlownFromRectumToCaecumAndBack)
{
    VICON_NEEDS_DATA("ctc-prone");
    ASSERT_NO_FATAL_FAILURE(openScan());
    ASSERT_NO_FATAL_FAILURE(flyThereAndBack());
    closeCase();
}

TEST_F(RealScan, IsReadFromWorklistToAnAmendedReportInTheArchiveAndAllIsBackAfterReopening)
{
    VICON_NEEDS_DATA("ctc-prone");
    ASSERT_NO_FATAL_FAILURE(openScan());
    fastest();
    ASSERT_NO_FATAL_FAILURE(markAndEdit());
    ASSERT_NO_FATAL_FAILURE(measure());
    ASSERT_NO_FATAL_FAILURE(lookBelowTheWall());
    ASSERT_NO_FATAL_FAILURE(circleAndTakeDensity());
    ASSERT_NO_FATAL_FAILURE(keepPictureAndMarkers());
    ASSERT_NO_FATAL_FAILURE(writeReport());
    ASSERT_NO_FATAL_FAILURE(signSendFindAmend(2, 2));
    ASSERT_NO_FATAL_FAILURE(closeAndReopen());
    EXPECT_EQ(stored(case_id_.c_str()).size(), 2U);
    closeCase();
}

class Phantom : public WholeWay {
protected:
    void openPhantom() { open("phantom", "phantom", phantomStudy()); }
    /// What was marked in the first scan, in the second.
    void pairWithOther()
    {
        openOther();
        jumpTo(length() * kPlace);
        place(Qt::Key_1, {140, 60});
        clickRow(markers(), 1);
        press(window(), "markerPair");
        clickRow(markers(), 0);
        ASSERT_TRUE(eventually([&] {
            const auto all = stored(case_id_.c_str());
            return settled() && partnerNames(all[0]) == all[1].id && partnerNames(all[1]) == all[0].id;
        }));
        screenshot("paired");
    }
    static constexpr double kPlace = 0.6;  ///< of the colon's length
};

TEST_F(Phantom, IsMarkedInBothScansPairedSignedSentFoundAndAmended)
{
    ASSERT_NO_FATAL_FAILURE(openPhantom());
    fastest();
    ASSERT_NO_FATAL_FAILURE(jumpTo(length() * kPlace));
    ASSERT_NO_FATAL_FAILURE(place(Qt::Key_1, {140, 60}));
    ASSERT_NO_FATAL_FAILURE(measure());
    ASSERT_NO_FATAL_FAILURE(pairWithOther());
    ASSERT_NO_FATAL_FAILURE(signSendFindAmend(1, 2));
    closeCase();
}

}  // namespace
}  // namespace vicon::viewer::test
