#include "vicon/ingest/acquisition_facts.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>
#include <gtest/gtest.h>

#include "dicom_writer.h"
#include "vicon/support/support.h"

namespace vicon::ingest {
namespace {

class Facts : public testing::Test {
protected:
    support::TemporaryFolder folder_;
    std::vector<std::filesystem::path> files_ = vicon::test::writeSeries(folder_ / "series", {});

    void put(const std::filesystem::path& file, const DcmTagKey& tag, const std::string& value) const
    {
        DcmFileFormat format;
        ASSERT_TRUE(format.loadFile(file.c_str()).good());
        ASSERT_TRUE(format.getDataset()->putAndInsertString(tag, value.c_str()).good());
        ASSERT_TRUE(format.saveFile(file.c_str(), EXS_LittleEndianExplicit).good());
    }
    AcquisitionFacts read() const
    {
        std::vector<InstanceRecord> instances;
        for (const auto& file : files_)
            instances.push_back({.file = file.filename().string()});
        return acquisitionFacts(folder_ / "series", instances);
    }
};

TEST_F(Facts, OfImagesThatSayNothingAreNone)
{
    const AcquisitionFacts facts = read();
    EXPECT_EQ(facts.reason, "");
    EXPECT_EQ(facts.contrast, "");
    EXPECT_FALSE(facts.dose_mgy_cm);
}

TEST_F(Facts, TheDoseIsThatOfEachImageTimesItsLength)
{
    for (std::size_t n = 0; n < files_.size(); ++n)
        put(files_[n], DCM_CTDIvol, n % 2 ? "5" : "3");
    ASSERT_TRUE(read().dose_mgy_cm);
    EXPECT_NEAR(*read().dose_mgy_cm, 4 * 12 * 0.2, 1e-6) << "12 images of 2 mm";
    DcmFileFormat format;
    ASSERT_TRUE(format.loadFile(files_[3].c_str()).good());
    format.getDataset()->findAndDeleteElement(DCM_CTDIvol);
    ASSERT_TRUE(format.saveFile(files_[3].c_str(), EXS_LittleEndianExplicit).good());
    EXPECT_FALSE(read().dose_mgy_cm) << "an image does not say it";
}

TEST_F(Facts, TheReasonIsTheOneSaidElseTheProcedure)
{
    put(files_[5], DCM_RequestedProcedureDescription, "CT colonography");
    put(files_[5], DCM_ContrastBolusAgent, "IOPAMIDOL");
    EXPECT_EQ(read().reason, "CT colonography");
    EXPECT_EQ(read().contrast, "IOPAMIDOL");
    put(files_[5], DCM_ReasonForTheRequestedProcedure, "positive FIT");
    EXPECT_EQ(read().reason, "positive FIT");
}

}  // namespace
}  // namespace vicon::ingest
