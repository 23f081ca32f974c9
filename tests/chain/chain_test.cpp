// From DICOM files to the last result: how a scan was stored and who computes must not matter.
#include "chain.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "vicon/support/support.h"

namespace vicon::test {
namespace {

/// A scan whose axes are the patient's, and what the chain makes of it; made once for all tests.
class Chain : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        NoProgress quiet;
        phantom::PhantomScan scan = phantom::makeScan(smallColon(3), "HFS", quiet);
        measured_ = new HuVolume(std::move(scan.hu));
        gravity_ = scan.truth.gravity;
        expected_ = new ChainResult(runChain(*measured_, gravity_));
    }
    static void TearDownTestSuite()
    {
        delete measured_;
        delete expected_;
    }
    static void expectTheSame(const ChainResult& got)
    {
        ASSERT_EQ(got.bytes.size(), expected_->bytes.size());
        for (const auto& [name, bytes] : expected_->bytes)
            EXPECT_TRUE(got.bytes.at(name) == bytes) << name;
    }

    static HuVolume* measured_;
    static Vector3 gravity_;
    static ChainResult* expected_;
};
HuVolume* Chain::measured_ = nullptr;
Vector3 Chain::gravity_;
ChainResult* Chain::expected_ = nullptr;

TEST_F(Chain, MakesEveryResultOfAColon)
{
    ASSERT_FALSE(expected_->curve.empty());
    EXPECT_GT(expected_->curve.length_mm(), 1000);
    for (const auto& [name, bytes] : expected_->bytes)
        EXPECT_GT(bytes.size(), 100U) << name;
}

TEST_F(Chain, IsBitForBitTheSameInWhateverOrderAndMirroringTheSeriesIsStored)
{
    for (const Storage& storage :
         std::vector<Storage>{{"as scanned"},
                              {"files in no order", {0, 1, 2}, {1, 1, 1}, true},
                              {"slices from head to feet", {0, 1, 2}, {1, 1, -1}},
                              {"rows mirrored", {0, 1, 2}, {-1, 1, 1}},
                              {"turned by 180 degrees, files in no order", {0, 1, 2}, {-1, -1, 1}, true, true},
                              {"rows and columns exchanged", {1, 0, 2}, {1, -1, -1}},
                              {"coronal slices", {0, 2, 1}, {1, -1, 1}, false, true}}) {
        SCOPED_TRACE(storage.name);
        const support::TemporaryFolder folder;
        HuVolume read = throughDicom(*measured_, storage, folder.path());
        if (storage.whole)
            expectTheSame(runChain(std::move(read), gravity_));
        else
            EXPECT_TRUE(runResample(std::move(read)).bytes.at("volume") == expected_->bytes.at("volume"));
    }
}

TEST_F(Chain, IsBitForBitTheSameOnAnyNumberOfThreads)
{
    for (const std::size_t threads : {1, 5}) {
        SCOPED_TRACE(threads);
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        expectTheSame(runChain(*measured_, gravity_));
    }
}

}  // namespace
}  // namespace vicon::test
