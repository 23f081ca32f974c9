// Another program's lumen, through the command.
#include <gmock/gmock.h>

#include "study.h"
#include "vicon/core/file.h"
#include "vicon/scan_files/volume_file.h"

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

using testing::HasSubstr;

InsideVolume maskOf(const ListedScan& scan)
{
    return scan_files::readVolume<std::uint8_t>(scan.folder / "mask.mha");
}

/// How alike two lumens are, 1 when they are one.
double dice(const InsideVolume& a, const InsideVolume& b)
{
    double own = 0, both = 0;
    for (std::size_t n = 0; n < a.voxels.size(); ++n)
        if (a.voxels[n]) {
            ++own;
            both += b.valueOr(b.grid.indexAt(a.grid.pointAt(a.grid.indexOf(n))), kOutside) != kOutside;
        }
    const auto other = std::count_if(b.voxels.begin(), b.voxels.end(), [](auto v) { return v != kOutside; });
    return 2 * both / (own + double(other));
}

/// A store in which VICON found the lumen itself, and that lumen as other programs would write it.
class GivenLumenOfTheCommand : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        folder_ = new TemporaryFolder;
        viconOn(found(), "import " + smallStudy().string());
        viconOn(found(), "work --until-idle");
        scan_ = listedScans(found()).at(0);
        write("proper", "nifti-sform.-20-1 nifti-qform.10-2 nrrd-ras.21-0 nrrd-las.012 meta.2-01");
        write("swapped", "");
        write("hostile", "two-labels empty");
    }
    static void TearDownTestSuite()
    {
        delete folder_;
        folder_ = nullptr;
    }
    static void write(const std::string& set, const std::string& names)
    {
        const auto done = runCommand(std::string(VICON_WRITE_MASKS) + " " + (scan_.folder / "mask.mha").string() + " " +
                                     masks().string() + " " + set + " " + names);
        ASSERT_EQ(done.exit_code, 0) << done.output;
    }
    static fs::path found() { return folder_->path() / "found"; }
    static fs::path masks() { return folder_->path() / "masks"; }
    /// A store of a test's own, as `found` is.
    static fs::path copyOfStore(const std::string& name)
    {
        const fs::path copy = folder_->path() / name;
        fs::copy(found(), copy, fs::copy_options::recursive);
        return copy;
    }
    static std::string importOf(const fs::path& file)
    {
        return "import --mask " + scan_.case_id + " " + scan_.scan_id + " " + file.string();
    }

    static TemporaryFolder* folder_;
    static ListedScan scan_;
};
TemporaryFolder* GivenLumenOfTheCommand::folder_ = nullptr;
ListedScan GivenLumenOfTheCommand::scan_;

TEST_F(GivenLumenOfTheCommand, IsTheSameFromEveryFormAndOrderOfItsAxes)
{
    const fs::path store = copyOfStore("orders");
    for (const char* file : {"nifti-sform.-20-1.nii", "nifti-qform.10-2.nii.gz", "nrrd-ras.21-0.nrrd",
                             "nrrd-las.012.nrrd", "meta.2-01.mha"}) {
        EXPECT_THAT(viconOn(store, importOf(masks() / file)), HasSubstr("97 % gas, 3 % tagged fluid")) << file;
        EXPECT_THAT(viconOn(store, "work --until-idle"), HasSubstr("1 done")) << file;
        EXPECT_EQ(dice(maskOf(listedScans(store).at(0)), maskOf(scan_)), 1) << file;
    }
}

TEST_F(GivenLumenOfTheCommand, TakesTheFoundOnesPlaceAndGivesItBackBitForBit)
{
    const fs::path store = folder_->path() / "there-and-back";
    viconOn(store, "import " + smallStudy().string());
    viconOn(store, importOf(masks() / "nifti-sform.-20-1.nii"));
    viconOn(store, "work --until-idle");
    const ListedScan scan = listedScans(store).at(0);
    EXPECT_EQ(schemaFaults("lumen", {scan.folder / "lumen.json"}), "");
    EXPECT_EQ(schemaFaults("scan", {scan.folder / "scan.json"}), "");
    EXPECT_THAT(viconOn(store, "show " + scan.case_id), HasSubstr("lumen: NIfTI, label 1, SHA-256 "));
    const auto given = viconJson(store, "show " + scan.case_id)["scans"][0]["steps"]["segment"]["result"]["given"];
    EXPECT_EQ(given["sha256"], sha256OfFile(masks() / "nifti-sform.-20-1.nii"));
    EXPECT_THAT(readFile(scan.folder / "scan.json"), testing::Not(HasSubstr(masks().string())));
    EXPECT_THAT(viconOn(store, "work --until-idle"), HasSubstr("0 done, 0 failed, 0 waiting"));

    EXPECT_THAT(viconOn(store, importOf("none")), HasSubstr("stored"));
    EXPECT_THAT(viconOn(store, importOf("none")), HasSubstr("unchanged"));
    viconOn(store, "work --until-idle");
    EXPECT_TRUE(filesOf(store) == filesOf(found()));
}

TEST_F(GivenLumenOfTheCommand, ThatCannotBeTheScansIsRefusedWithALineAndNothingChanges)
{
    struct Refused {
        const char* file;
        int exit_code;
        const char* words;
    };
    constexpr Refused kRefused[] = {
        {"sides-swapped.nii.gz", 1, "100 % with left and right swapped"},
        {"front-swapped.nii.gz", 1, "100 % with front and back swapped"},
        {"head-swapped.nii.gz", 1, "100 % with head and feet swapped"},
        {"ras-for-lps.nrrd", 1, "100 % with "},
        {"elsewhere.nii.gz", 1, "does not overlap the scan"},
        {"full.nii.gz", 1, "does not lie where the scan's lumen is"},
        {"empty.nii", 1, "is empty"},
        {"two-labels.nrrd", 2, "has several labels: 1, 7"},
        {"two-labels.nrrd --label 3", 2, "has no label 3"},
        {"nowhere.nii", 1, "no such file"},
    };
    const fs::path store = copyOfStore("refused");
    const auto before = filesOf(store);
    for (const Refused& refused : kRefused) {
        const auto result = runVicon(importOf(masks() / refused.file) + " --store " + store.string());
        EXPECT_EQ(result.exit_code, refused.exit_code) << refused.file << "\n" << result.output;
        EXPECT_THAT(result.output, HasSubstr(refused.words)) << refused.file;
    }
    for (const char* wrong : {"import", "import --mask", "import --label 1 /tmp"}) {
        const auto result = runVicon(std::string(wrong) + " --store " + store.string());
        EXPECT_EQ(result.exit_code, 2) << wrong << "\n" << result.output;
    }
    EXPECT_TRUE(filesOf(store) == before);
    EXPECT_THAT(viconOn(store, "work --until-idle"), HasSubstr("0 done, 0 failed, 0 waiting"));
}

TEST_F(GivenLumenOfTheCommand, IsCorrectedAsAFoundOneIs)
{
    const fs::path store = copyOfStore("corrected");
    viconOn(store, importOf(masks() / "two-labels.nrrd --label 7"));
    viconOn(store, "work --until-idle");
    const auto millilitres = [&] {
        const auto result = viconJson(store, "show " + scan_.case_id)["scans"][0]["steps"]["segment"]["result"];
        return result["gas_ml"].get<double>() + result["fluid_ml"].get<double>();
    };
    const double half_ml = millilitres();
    const auto plan = viconJson(found(), "show " + scan_.case_id)["scans"][0]["steps"]["segment"]["result"]["plan"];
    const double whole_ml = plan["pieces"][0]["volume_ml"];
    EXPECT_LT(half_ml, 0.9 * whole_ml);
    const nlohmann::json end = plan["pieces"][0]["caecal_end_mm"];
    const std::string at = end[0].dump() + "," + end[1].dump() + "," + end[2].dump();
    viconOn(store, "work --until-idle --case " + scan_.case_id + " --add=" + at);
    EXPECT_GT(millilitres(), half_ml + 100);
    viconOn(store, "work --until-idle --case " + scan_.case_id + " --forget-corrections");
    EXPECT_DOUBLE_EQ(millilitres(), half_ml);
}

TEST_F(GivenLumenOfTheCommand, IsNotCalledViconsInAnyFormOfAReport)
{
    const fs::path store = folder_->path() / "named", config = folder_->path() / "c.toml";
    readSmallStudy(store);
    viconOn(store, importOf(masks() / "nifti-sform.-20-1.nii"));
    viconOn(store, "work --until-idle");
    replaceFile(config, "[roles]\nsign = [\"" + runCommand("id -un | tr -d '\\n'").output + "\"]\n");
    viconOn(store, "sign " + scan_.case_id + " --config " + config.string());
    const fs::path report = store / "cases" / scan_.case_id / "report", plain = folder_->path() / "lumen.dcm";
    runCommand("dcmconv +te " + (report / ("version-1-lumen-" + scan_.scan_id + ".dcm")).string() + " " +
               plain.string());
    const std::string dump = runCommand("dcmdump +L " + plain.string()).output;
    EXPECT_THAT(dump, HasSubstr("[Lumen of the colon, made by another program]"));
    EXPECT_THAT(dump, HasSubstr("[Another program's, not known to VICON]"));
    EXPECT_THAT(dump, HasSubstr("[Made by another program: NIfTI, label 1, SHA-256 " +
                                sha256OfFile(masks() / "nifti-sform.-20-1.nii").substr(0, 12)));
    EXPECT_THAT(dump, testing::Not(HasSubstr("segmented by VICON")));
    EXPECT_THAT(runCommand("dciodvfy " + plain.string()).output, testing::Not(HasSubstr("Error")));

    const std::string sha256 = sha256OfFile(masks() / "nifti-sform.-20-1.nii");
    EXPECT_EQ(
        viconJson(store, "export " + scan_.case_id + " --as json")["content"]["scans"][0]["given_lumen"]["sha256"],
        sha256);
    for (const char* form : {"text", "fhir", "hl7"})
        EXPECT_THAT(viconOn(store, "export " + scan_.case_id + " --as " + form),
                    testing::AllOf(HasSubstr("made by another program"), HasSubstr(sha256.substr(0, 12))))
            << form;
    EXPECT_THAT(runCommand("dsrdump +Pl " + (report / "version-1-sr.dcm").string()).output,
                HasSubstr("Made by another program: NIfTI, label 1, SHA-256 " + sha256.substr(0, 12)));
}

TEST_F(GivenLumenOfTheCommand, OfASignedReportComesBackAsItWasAndMarkersAndReportStay)
{
    const fs::path store = folder_->path() / "signed", out = folder_->path() / "exported";
    readSmallStudy(store);
    const fs::path config = folder_->path() / "c.toml";
    replaceFile(config, "[roles]\nsign = [\"" + runCommand("id -un | tr -d '\\n'").output + "\"]\n");
    viconOn(store, "sign " + scan_.case_id + " --config " + config.string());
    viconOn(store, "export " + scan_.case_id + " --as dicom --out " + out.string());
    const auto markers = viconJson(store, "markers " + scan_.case_id);
    constexpr std::size_t kHeaderBytes = 500;
    fs::path segmentation;
    for (const auto& entry : fs::directory_iterator(out))
        if (readFile(entry.path()).substr(0, kHeaderBytes).find("1.2.840.10008.5.1.4.1.1.66.4") != std::string::npos)
            segmentation = entry.path();
    ASSERT_FALSE(segmentation.empty());
    const auto before = filesOf(store);
    EXPECT_THAT(viconOn(store, importOf(segmentation)), HasSubstr("DICOM SEG, label 1"));
    viconOn(store, "work --until-idle");
    const InsideVolume own = scan_files::readVolume<std::uint8_t>(scan_.folder / "inside.mha");
    EXPECT_GT(dice(maskOf(listedScans(store).at(0)), own), 0.98) << "slices of 3.2 mm, voxels of 2.4 mm";
    for (const auto& [file, content] : filesOf(store))
        if (file.find("/report/") != std::string::npos) {
            EXPECT_TRUE(before.at(file) == content) << file;
        }
    const auto after = viconJson(store, "markers " + scan_.case_id);
    EXPECT_EQ(after["markers"][0]["position_mm"], markers["markers"][0]["position_mm"]);
    EXPECT_NEAR(after["markers"][0]["station_mm"].get<double>(), markers["markers"][0]["station_mm"].get<double>(), 5);
    viconOn(store, "report " + scan_.case_id + " --out " + (folder_->path() / "draft.pdf").string());
    EXPECT_THAT(runCommand("pdftotext -layout " + (folder_->path() / "draft.pdf").string() + " -").output,
                HasSubstr("DICOM SEG, label 1, SHA-256"));
    EXPECT_EQ(runVicon("backup " + (folder_->path() / "backup").string() + " --store " + store.string()).exit_code, 0);
    EXPECT_TRUE(fs::exists(folder_->path() / "backup" / "cases" / scan_.case_id / scan_.scan_id / "lumen.json"));

    const fs::path other = folder_->path() / "other";
    viconOn(folder_->path(), "phantom " + other.string() + "-study --supine --size 96x96x80 --no-folds --seed 5");
    viconOn(other, "import " + other.string() + "-study");
    const ListedScan foreign = listedScans(other).at(0);
    const auto refused = runVicon("import --mask " + foreign.case_id + " " + foreign.scan_id + " " +
                                  segmentation.string() + " --store " + other.string());
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.output, HasSubstr("another frame of reference"));
}

}  // namespace
}  // namespace vicon::support
