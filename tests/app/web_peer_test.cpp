// A peer by DICOMweb, from outside: the commands that name it know no difference.
#include <gmock/gmock.h>

#include "dicom_writer.h"
#include "orthanc.h"
#include "study.h"
#include "vicon/cases/case_store.h"

namespace vicon::support {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class WebPeer : public testing::Test {
protected:
    TemporaryFolder folder_;
    test::Orthanc orthanc_{folder_ / "orthanc", 0, {}, test::withDicomWeb()};
    const std::filesystem::path store_ = folder_ / "store", config_ = folder_ / "c.toml";
    const test::SeriesSpec spec_;

    void SetUp() override
    {
        replaceFile(config_, "[peers]\nweb = { url = \"" + orthanc_.webPeer().web->url +
                                 "/\" }\n[watch]\n"
                                 "least_slices = 10\ndays = 36500\n");
        ASSERT_TRUE(orthanc_.answers());
    }
    CommandResult vicon(const std::string& arguments) const
    {
        return runVicon(arguments + " --store " + store_.string() + " --config " + config_.string() + " 2>&1");
    }
};

TEST_F(WebPeer, IsSentToAskedAndFetchedFrom)
{
    test::writeSeries(folder_ / "in", spec_);
    ASSERT_EQ(vicon("import " + (folder_ / "in").string()).exit_code, 0);
    const std::string case_id = CaseStore::caseIdFor(spec_.study_uid);
    const auto sent = vicon("send " + case_id + " web --images");
    EXPECT_EQ(sent.exit_code, 0) << sent.output;
    EXPECT_THAT(sent.output, HasSubstr("12 objects for web: 12 committed"));
    EXPECT_EQ(orthanc_.objects(), 12U);
    const auto found = vicon("query web --patient P1");
    EXPECT_THAT(found.output, AllOf(HasSubstr("Doe^Jane"), HasSubstr(spec_.study_uid)));
    ASSERT_EQ(vicon("delete " + case_id + " --yes").exit_code, 0);
    const auto fetched = vicon("retrieve web " + spec_.study_uid);
    EXPECT_EQ(fetched.exit_code, 0) << fetched.output;
    EXPECT_THAT(fetched.output, HasSubstr("12 objects retrieved, 0 failed"));
    EXPECT_EQ(viconJson(store_, "cases")["cases"].size(), 1U);
    const auto again = vicon("retrieve web " + spec_.study_uid);
    EXPECT_THAT(again.output, HasSubstr("everything was there already"));
    EXPECT_THAT(vicon("doctor").output, HasSubstr(orthanc_.webPeer().web->url + " answers"));
}

TEST_F(WebPeer, IsWatched)
{
    NoProgress quiet;
    ASSERT_TRUE(ingest::storeFiles(orthanc_.peer(), test::writeSeries(folder_ / "in", spec_), "CT", quiet).complete());
    vicon("watch web --once");
    EXPECT_THAT(vicon("watch web --once").output, HasSubstr("12 objects fetched, 0 failed"));
}

TEST_F(WebPeer, ThatIsWrittenWronglyIsSaid)
{
    const auto told = [&](const std::string& entry) {
        replaceFile(config_, "[peers]\nweb = { " + entry + " }\n");
        const auto result = vicon("query web");
        EXPECT_EQ(result.exit_code, 2);
        return result.output;
    };
    EXPECT_THAT(told("url = \"pacs\""), HasSubstr("no URL of a DICOMweb service"));
    EXPECT_THAT(told("url = \"https://pacs.example.org\", retrieve = \"push\""),
                HasSubstr("retrieve cannot be 'push'"));
    EXPECT_THAT(told("url = 5"), HasSubstr("'url = 5' is not understood"));
    EXPECT_THAT(told("url = \"http://pacs.example.org\", user = \"a\", password_file = \"b\""),
                HasSubstr("unencrypted"));
    EXPECT_THAT(told("url = \"https://pacs.example.org\", roles = [\"send\"]"), HasSubstr("not to be asked"));
}

}  // namespace
}  // namespace vicon::support
