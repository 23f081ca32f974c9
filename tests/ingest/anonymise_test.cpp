// Nothing of the person stays, and everything of the picture: judged by pydicom and dicom3tools.
#include "vicon/ingest/anonymise.h"

#include <gmock/gmock.h>

#include <fstream>

#include "anonymous_object.h"
#include "import_fixture.h"
#include "pseudonyms.h"
#include "stream_comments.h"
#include "vicon/core/error.h"

namespace vicon::ingest {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Anonymous : public test::StoreFixture {
protected:
    const fs::path originals_ = folder / "originals", out_ = folder / "out";

    static void script(const std::string& arguments)
    {
        const auto ran = support::runCommand(VICON_ANONYMOUS " " + arguments);
        EXPECT_EQ(ran.exit_code, 0) << ran.output;
    }
    std::string caseOf()
    {
        script("identify " + originals_.string());
        const ImportReport report = import({originals_});
        EXPECT_EQ(report.scans_stored, 1) << lines(report);
        return store.cases().at(0).id;
    }
    Anonymised write(const std::string& case_id) { return anonymise(store, case_id, out_, quiet); }
    void check() { script("check " + originals_.string() + " " + out_.string()); }
    /// The same voxels, in another store.
    void expectSameVoxels(const std::string& case_id)
    {
        CaseStore other(folder / "other");
        const ImportReport report = importPaths(other, {out_}, options, quiet);
        EXPECT_EQ(report.scans_stored, 1) << lines(report);
        const CaseRecord again = other.cases().at(0);
        EXPECT_NE(again.id, case_id);
        const ScanRecord scan = other.requireScan(again.id, "");
        const auto before = load(store.requireScan(case_id, ""));
        const auto after = loadScan(other.scanFolder(again.id, scan.id) / "dicom", options, quiet);
        EXPECT_EQ(after.voxels, before.voxels);
        EXPECT_EQ(scan.ingest["geometry"], store.requireScan(case_id, "").ingest["geometry"]);
        EXPECT_THAT(again.patient.name, testing::StartsWith("anon-"));
    }
};

TEST_F(Anonymous, ACaseKeepsItsPictureAndNothingOfThePerson)
{
    test::writeSeries(originals_, {});
    const std::string id = caseOf();
    EXPECT_EQ(write(id).written, 12);
    check();
    expectSameVoxels(id);
}

TEST_F(Anonymous, AnEnhancedCaseToo)
{
    test::writeEnhanced((fs::create_directories(originals_), originals_ / "1.dcm"), {},
                        {3, 1, 2, 0, 4, 5, 6, 11, 10, 9, 8, 7});
    const std::string id = caseOf();
    EXPECT_EQ(write(id).written, 1);
    check();
    expectSameVoxels(id);
}

TEST_F(Anonymous, ACaseOfMrToo)
{
    test::SeriesSpec spec;
    spec.mr_images = true;
    spec.modality = "MR";
    test::writeSeries(originals_, spec);
    const std::string id = caseOf();
    EXPECT_EQ(write(id).written, 12);
    check();
    expectSameVoxels(id);
    for (const auto& file : fs::recursive_directory_iterator(out_)) {
        if (!file.is_regular_file())
            continue;
        DcmFileFormat format;
        ASSERT_TRUE(format.loadFile(file.path().c_str()).good());
        for (const DcmTagKey& tag : {DCM_Manufacturer, DCM_PositionReferenceIndicator, DCM_EchoTime, DCM_ScanOptions})
            EXPECT_TRUE(format.getDataset()->tagExists(tag)) << DcmTag(tag).getTagName();
    }
}

TEST_F(Anonymous, TheSameCaseBecomesTheSameAgain)
{
    test::writeSeries(originals_, {});
    const std::string id = caseOf();
    write(id);
    const auto first = support::runCommand("cd " + out_.string() + " && sha256sum */*");
    fs::remove_all(out_);
    write(id);
    EXPECT_EQ(support::runCommand("cd " + out_.string() + " && sha256sum */*").output, first.output);
    fs::remove_all(out_);
    fs::remove(store.folder() / "anonymous.key");
    write(id);
    EXPECT_NE(support::runCommand("cd " + out_.string() + " && sha256sum */*").output, first.output)
        << "nobody can make it without the key";
}

TEST_F(Anonymous, TwoPatientsOfOneIdAreTwoAndOneWrittenOtherwiseIsOne)
{
    const auto pseudonymOf = [this](const std::string& name, const std::string& birth_date, const std::string& uid) {
        test::SeriesSpec spec;
        spec.patient_name = name;
        spec.birth_date = birth_date;
        spec.study_uid = uid;
        spec.series_uid = uid + ".1";
        test::writeSeries(folder / uid, spec);
        import({folder / uid});
        const fs::path out = folder / ("out of " + uid);
        anonymise(store, store.findCaseByStudy(uid)->id, out, quiet);
        CaseStore other(folder / ("store of " + uid));
        importPaths(other, {out}, options, quiet);
        return other.cases().at(0).patient.id;
    };
    const std::string first = pseudonymOf("Doe^Jane", "19600101", "1.2.1");
    EXPECT_NE(pseudonymOf("Roe^Mary", "19600101", "1.2.2"), first);
    EXPECT_NE(pseudonymOf("Doe^Jane", "19700101", "1.2.3"), first);
    EXPECT_EQ(pseudonymOf("DOE^JANE", "19600101", "1.2.4"), first);
}

TEST_F(Anonymous, WhatMayHoldTextInItsPixelsIsLeftOut)
{
    test::writeSeries(originals_, {});
    const std::string id = caseOf();
    const ScanRecord scan = store.requireScan(id, "");
    const auto instances = store.instances(id, scan.id);
    const auto edit = [&](int n, const std::string& element) {
        const fs::path file = store.scanFolder(id, scan.id) / "dicom" / instances.at(std::size_t(n)).file;
        EXPECT_EQ(support::runCommand("dcmodify -nb -i \"" + element + "\" " + file.string()).exit_code, 0);
    };
    edit(0, "(0028,0301)=YES");
    edit(1, "(0008,0008)=DERIVED\\\\SECONDARY\\\\SCREEN SAVE");
    edit(2, "(0008,0016)=1.2.840.10008.5.1.4.1.1.7");
    edit(3, "(6000,0100)=16");
    const Anonymised made = write(id);
    EXPECT_EQ(made.written, 8);
    const std::map<std::string, int> expected = {{"text burnt into its pixels", 1},
                                                 {"a page, not a slice", 1},
                                                 {"no image of CT or MR", 1},
                                                 {"an overlay in its pixels", 1}};
    EXPECT_EQ(made.left_out, expected);
}

TEST_F(Anonymous, WhatLiesBehindTheEndOfAFileIsLeftOut)
{
    const auto files = test::writeSeries(originals_, {});
    script("identify " + originals_.string());
    std::ofstream(files.at(4), std::ios::binary | std::ios::app) << "a note on Doe, Jane";
    import({originals_});
    EXPECT_EQ(write(store.cases().at(0).id).written, 12);
    for (const auto& entry : fs::recursive_directory_iterator(out_))
        if (entry.is_regular_file()) {
            EXPECT_EQ(readFile(entry.path()).find("a note on"), std::string::npos);
        }
}

TEST_F(Anonymous, AFolderWithSomethingInItIsNotTouched)
{
    test::writeSeries(originals_, {});
    const std::string id = caseOf();
    fs::create_directories(out_);
    replaceFile(out_ / "letter", "of somebody");
    EXPECT_THROW(write(id), Error);
    EXPECT_EQ(readFile(out_ / "letter"), "of somebody");
}

TEST(AnonymousObject, ThatLacksItsUidsHasThoseOfItsPlace)
{
    const Pseudonyms pseudonyms("key", "patient");
    DcmDataset dataset;
    dataset.putAndInsertString(DCM_SOPClassUID, UID_CTImageStorage);
    dataset.putAndInsertString(DCM_SeriesInstanceUID, "1.2");
    makeAnonymous(dataset, pseudonyms, {"1.1", "1.2", "1.3"});
    const auto uidOf = [&](const DcmTagKey& tag) {
        OFString text;
        dataset.findAndGetOFString(tag, text);
        return std::string(text.c_str());
    };
    EXPECT_EQ(uidOf(DCM_StudyInstanceUID), pseudonyms.uid("1.1"));
    EXPECT_EQ(uidOf(DCM_SeriesInstanceUID), pseudonyms.uid("1.2"));
    EXPECT_EQ(uidOf(DCM_SOPInstanceUID), pseudonyms.uid("1.3"));
}

TEST(Pseudonym, DatesMoveByOneSpanForEachPatient)
{
    const Pseudonyms one("key", "4711"), again("key", "4711"), other("key", "4712");
    EXPECT_EQ(one.patient(), again.patient());
    EXPECT_NE(one.patient(), other.patient());
    EXPECT_EQ(one.uid("1.2.3"), other.uid("1.2.3"));
    EXPECT_EQ(one.uid("1.2.840.10008.5.1.4.1.1.2"), "1.2.840.10008.5.1.4.1.1.2");
    const auto first = one.earlier("20240110", "235959.5"), later = one.earlier("20240111", "000000.5");
    EXPECT_LT(first.date, "20230111");
    EXPECT_GT(first.date, "20120101");
    EXPECT_THAT(first.time, HasSubstr(".5"));
    EXPECT_EQ(one.earlier("20240110235959.5+0100"), first.date + first.time);
    EXPECT_NE(first.date + first.time, later.date + later.time);
    EXPECT_NE(other.earlier("20240110", "235959.5").date + other.earlier("20240110", "235959.5").time,
              first.date + first.time);
    EXPECT_EQ(one.earlier("2024.01.10", "23:59:59.5").date, first.date);
    EXPECT_EQ(one.earlier("20241340", "101500").date, "");
    EXPECT_EQ(one.earlier("20240110", "").time, "");
}

TEST(StreamComments, AreBlankedAndTheRestStays)
{
    const auto bytes = [](const std::string& text) { return std::vector<std::uint8_t>(text.begin(), text.end()); };
    const std::string start = "\xFF\xD8", jfif("\xFF\xE0\x00\x04JF", 6), rest = "\xFF\xDA ZZID in the scan stays";
    auto jpeg =
        bytes(start + jfif + std::string("\xFF\xFE\x00\x06ZZID", 8) + std::string("\xFF\xE1\x00\x06ZZID", 8) + rest);
    blankComments(jpeg);
    EXPECT_EQ(jpeg, bytes(start + jfif + std::string("\xFF\xFE\x00\x06\0\0\0\0", 8) +
                          std::string("\xFF\xE1\x00\x06\0\0\0\0", 8) + rest));
    auto jpeg2000 = bytes("\xFF\x4F" + std::string("\xFF\x64\x00\x08\x00\x01ZZID", 10) + "\xFF\x90 tile");
    blankComments(jpeg2000);
    EXPECT_EQ(jpeg2000, bytes("\xFF\x4F" + std::string("\xFF\x64\x00\x08\x00\x01\0\0\0\0", 10) + "\xFF\x90 tile"));
    auto cut = bytes(start + std::string("\xFF\xFE\x7F\xFFZZ", 6));
    blankComments(cut);
    EXPECT_EQ(cut, bytes(start + std::string("\xFF\xFE\x7F\xFF\0\0", 6)));
    auto raw = bytes("ZZID");
    blankComments(raw);
    EXPECT_EQ(raw, bytes("ZZID"));
}

}  // namespace
}  // namespace vicon::ingest
