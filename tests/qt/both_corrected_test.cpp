// Two scans of a case are done again: each is shown anew, the one that is read and the one beside it.
#include <QTableWidget>
#include <atomic>
#include <mutex>
#include <set>
#include <thread>

#include "correcting.h"
#include "test_colon.h"

namespace vicon::viewer {
namespace {

using test::Correcting;

/// The pipeline does a queue of several scans, when it is let.
class CorrectingBoth : public Correcting {
protected:
    void SetUp() override
    {
        Correcting::SetUp();
        queue_ = std::make_shared<Queue>();
        ReadingServices services = test::servicesFor(store_);
        services.correct = [queue = queue_](CaseStore&, const ScanRecord& scan, const Corrections&,
                                            const Corrections&) {
            const std::lock_guard lock(queue->mutex);
            queue->waiting.insert(scan.id);
        };
        services.work = [queue = queue_](CaseStore& store, const std::atomic<bool>& stop) {
            while (!queue->go && !stop)
                std::this_thread::yield();
            const std::lock_guard lock(queue->mutex);
            for (const std::string& scan : queue->waiting)
                doneAgain().write(store.scanFolder(test::kCase, scan));
            queue->waiting.clear();
        };
        services.worklist = [queue = queue_, before = services.worklist](CaseStore& store,
                                                                         const WorklistPageWanted& wanted) {
            WorklistPage page = before(store, wanted);
            const std::lock_guard lock(queue->mutex);
            for (WorklistCase& row : page.cases)
                for (WorklistScan& scan : row.scans)
                    if (queue->waiting.contains(scan.record.id))
                        scan.state = scan.record.id == *queue->waiting.begin() ? WorkState::running : WorkState::queued;
            return page;
        };
        room_.reset();
        openRoom(services);
        openCase();
        window()->resize(1900, 1050);
        showList(2);
        key(Qt::Key_C);
        ASSERT_TRUE(eventually([] { return drawn("besideAxial"); }));
        waitUntilQuiet();
        before_ = greyOf("axial");
        before_beside_ = greyOf("besideAxial");
    }
    /// Done again, its body is lighter.
    static test::TestColon doneAgain()
    {
        test::TestColon colon;
        for (std::int16_t& hu : colon.volume.voxels)
            hu = std::int16_t(hu > -500 ? hu + 300 : hu);
        return colon;
    }
    static double greyOf(const char* view)
    {
        const QImage picture = pictureOf(view).convertToFormat(QImage::Format_Grayscale8);
        double sum = 0;
        for (int y = 0; y < picture.height(); ++y)
            for (int x = 0; x < picture.width(); ++x)
                sum += picture.constScanLine(y)[x];
        return sum / (picture.width() * picture.height());
    }

    struct Queue {
        std::mutex mutex;
        std::set<std::string> waiting;
        std::atomic<bool> go = false;
    };
    std::shared_ptr<Queue> queue_;
    double before_ = 0, before_beside_ = 0;      // their grey
    static constexpr double kLighter_grey = 20;  // 300 HU are 51 levels of grey, where there is tissue
};

TEST_F(CorrectingBoth, EachIsShownAnewAlsoWhereTheOtherIsCorrectedBeforeItIsDone)
{
    correctAlongThePath("correctCut");
    the<QLabel>("where")->clear();
    key(Qt::Key_X);
    waitForPictures();
    ASSERT_LT(greyOf("axial"), before_ + kLighter_grey);
    correctAlongThePath("correctCut");
    ASSERT_TRUE(eventually([&] {
        const std::lock_guard lock(queue_->mutex);
        return queue_->waiting.size() == 2;
    }));
    queue_->go = true;
    waitForNewScan();
    EXPECT_GT(greyOf("axial"), before_ + kLighter_grey) << "the one that is read";
    EXPECT_TRUE(eventually([&] { return greyOf("besideAxial") > before_beside_ + kLighter_grey; })) << "and the other";
    screenshot("both_corrected");
    the<QLabel>("where")->clear();
    key(Qt::Key_X);
    waitForScan();
    EXPECT_GT(greyOf("axial"), before_ + kLighter_grey);
}

TEST_F(CorrectingBoth, TheScanBesideIsReadAnewWhereItWasDoneAgainSinceItWasOpened)
{
    doneAgain().write(store_ / "cases" / test::kCase / test::kProne);
    the<QLabel>("where")->clear();
    key(Qt::Key_X);
    waitForScan();
    EXPECT_GT(greyOf("axial"), before_ + kLighter_grey);
    EXPECT_LT(greyOf("besideAxial"), before_beside_ + kLighter_grey) << "the one that was read is beside";
}

TEST_F(CorrectingBoth, TheScanBesideIsShownAnewWhenItIsDoneAgainForAnotherReader)
{
    const auto queue = [&](bool on) {
        const std::lock_guard lock(queue_->mutex);
        queue_->waiting = on ? std::set<std::string>{test::kProne} : std::set<std::string>{};
    };
    queue(true);
    const auto progress = [&] { return cases()->item(0, 5)->text() + cases()->item(1, 5)->text(); };
    ASSERT_TRUE(eventually([&] { return progress().contains(","); })) << "the worklist shows that it is being done";
    doneAgain().write(store_ / "cases" / test::kCase / test::kProne);
    queue(false);
    EXPECT_TRUE(eventually([&] { return greyOf("besideAxial") > before_beside_ + kLighter_grey; }));
    EXPECT_LT(greyOf("axial"), before_ + kLighter_grey);
}

}  // namespace
}  // namespace vicon::viewer
