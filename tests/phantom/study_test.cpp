#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include "scans.h"
#include "vicon/core/error.h"
#include "vicon/scan_files/volume_file.h"
#include "vicon/support/support.h"

namespace fs = std::filesystem;

namespace vicon::phantom {
namespace {

/// A small study with a supine, a prone and a decubitus scan.
struct Study {
    Study() : out(folder / "study"), options(smallOptions(5))
    {
        options.decubitus = Decubitus::left;
        options.oblique_deg = 7;
        NoProgress progress;
        writeStudy(out, options, progress);
    }
    support::TemporaryFolder folder;
    fs::path out;
    PhantomOptions options;
};

/// Made once.
const Study& study()
{
    static const Study made;
    return made;
}

std::vector<fs::path> dicomFiles(const fs::path& folder)
{
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".dcm")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::string text(DcmDataset& set, const DcmTagKey& tag)
{
    OFString value;
    set.findAndGetOFStringArray(tag, value);
    return value.c_str();
}

TEST(PhantomStudy, PleasesTheValidator)
{
    if (support::runCommand("command -v dciodvfy").exit_code != 0)
        GTEST_SKIP() << "needs dciodvfy";
    int checked = 0;
    std::map<std::string, int> in_folder;
    for (const fs::path& file : dicomFiles(study().out)) {
        if (++in_folder[file.parent_path().string()] > 12)
            continue;  // slices of one series differ in numbers only
        ++checked;
        const std::string said = support::runCommand("dciodvfy '" + file.string() + "' 2>&1").output;
        EXPECT_EQ(said.find("Error"), std::string::npos) << file << "\n" << said;
    }
    EXPECT_GE(checked, 38);
}

TEST(PhantomStudy, HoldsEveryScansVoxelsAtTheirPlaces)
{
    NoProgress progress;
    const PhantomScan scan = makeScan(study().options, "HFP", progress);
    int slices = 0;
    for (const fs::path& file : dicomFiles(study().out / "series-3-prone")) {
        DcmFileFormat format;
        ASSERT_TRUE(format.loadFile(file.string().c_str()).good());
        DcmDataset& set = *format.getDataset();
        double x = 0, y = 0, z = 0;
        set.findAndGetFloat64(DCM_ImagePositionPatient, x, 0);
        set.findAndGetFloat64(DCM_ImagePositionPatient, y, 1);
        set.findAndGetFloat64(DCM_ImagePositionPatient, z, 2);
        const ContinuousIndex3 at = scan.hu.grid.continuousIndexAt({x, y, z});
        EXPECT_NEAR(at.i, 0, 1e-4);
        EXPECT_NEAR(at.j, 0, 1e-4);
        EXPECT_NEAR(at.k, std::round(at.k), 1e-4);
        const std::size_t first = scan.hu.grid.offset({0, 0, int(std::round(at.k))});
        const Uint16* pixels = nullptr;
        unsigned long count = 0;
        ASSERT_TRUE(set.findAndGetUint16Array(DCM_PixelData, pixels, &count).good());
        ASSERT_EQ(count, std::size_t(scan.hu.grid.size[0]) * std::size_t(scan.hu.grid.size[1]));
        std::size_t differing = 0;
        for (std::size_t n = 0; n < count; ++n) {
            const auto stored = std::int16_t(pixels[n]);
            differing += (stored == -2000 ? kPaddingHu : stored - 1024) != scan.hu.voxels[first + n];
        }
        EXPECT_EQ(differing, 0U) << file;
        EXPECT_EQ(text(set, DCM_PatientPosition), "HFP");
        ++slices;
    }
    EXPECT_EQ(slices, scan.hu.grid.size[2]);
}

TEST(PhantomStudy, IsOneStudyOfOnePatientWithDistinctInstances)
{
    std::set<std::string> studies, patients, series, instances;
    for (const fs::path& file : dicomFiles(study().out)) {
        DcmFileFormat format;
        ASSERT_TRUE(format.loadFile(file.string().c_str()).good());
        DcmDataset& set = *format.getDataset();
        studies.insert(text(set, DCM_StudyInstanceUID));
        patients.insert(text(set, DCM_PatientName) + text(set, DCM_PatientID));
        series.insert(text(set, DCM_SeriesInstanceUID));
        EXPECT_TRUE(instances.insert(text(set, DCM_SOPInstanceUID)).second);
    }
    EXPECT_EQ(studies.size(), 1U);
    EXPECT_EQ(patients, std::set<std::string>{"Phantom^Seed5PHANTOM-5"});
    EXPECT_EQ(series.size(), 5U) << "three scans, a localizer, a dose sheet";
}

TEST(PhantomStudy, NamesFilesInAnotherOrderThanTheSlices)
{
    std::vector<double> heights;
    for (const fs::path& file : dicomFiles(study().out / "series-2-supine")) {
        DcmFileFormat format;
        ASSERT_TRUE(format.loadFile(file.string().c_str()).good());
        heights.push_back(0);
        format.getDataset()->findAndGetFloat64(DCM_ImagePositionPatient, heights.back(), 2);
    }
    int turns = 0;
    for (std::size_t n = 2; n < heights.size(); ++n)
        turns += (heights[n] > heights[n - 1]) != (heights[n - 1] > heights[n - 2]);
    EXPECT_GT(turns, int(heights.size()) / 3);
}

TEST(PhantomStudy, HasTheTruthBesideIt)
{
    for (const std::string name : {"supine", "prone", "decubitus-left"}) {
        std::ifstream file(study().out / ("truth-" + name + ".json"));
        const nlohmann::json truth = nlohmann::json::parse(file);
        const auto inside = scan_files::readVolume<std::uint8_t>(study().out / ("truth-" + name + "-inside.mha"));
        const auto count =
            std::count_if(inside.voxels.begin(), inside.voxels.end(), [](auto label) { return label > 0; });
        EXPECT_NEAR(truth["volume_ml"].get<double>(), double(count) * inside.grid.voxelVolume_mm3() / 1000, 0.01);
        EXPECT_EQ(truth["polyps"].size(), 5U);
        EXPECT_EQ(truth["options"]["phantom.seed"].get<int>(), 5);
    }
    DcmFileFormat format;
    ASSERT_TRUE(format.loadFile(dicomFiles(study().out / "series-2-supine")[0].string().c_str()).good());
    std::ifstream file(study().out / "truth-supine.json");
    EXPECT_EQ(nlohmann::json::parse(file)["scan"], text(*format.getDataset(), DCM_SeriesInstanceUID));
}

TEST(PhantomStudy, SetsLocalizerAndDoseSheetApartByTheirKind)
{
    DcmFileFormat localizer, dose;
    ASSERT_TRUE(localizer.loadFile(dicomFiles(study().out / "series-1-localizer").at(0).string().c_str()).good());
    ASSERT_TRUE(dose.loadFile(dicomFiles(study().out / "series-999-dose").at(0).string().c_str()).good());
    EXPECT_EQ(text(*localizer.getDataset(), DCM_ImageType), "ORIGINAL\\PRIMARY\\LOCALIZER");
    EXPECT_EQ(text(*dose.getDataset(), DCM_SOPClassUID), UID_SecondaryCaptureImageStorage);
}

TEST(PhantomStudy, GivesOtherVoxelsOtherIdentifiers)
{
    support::TemporaryFolder folder;
    PhantomOptions options = study().options;
    options.decubitus = Decubitus::none;
    options.prone = false;
    options.extras = false;
    options.noise_hu = 5;
    NoProgress progress;
    writeStudy(folder / "a", options, progress);
    const auto uidOf = [](const fs::path& file) {
        DcmFileFormat format;
        format.loadFile(file.string().c_str());
        return text(*format.getDataset(), DCM_StudyInstanceUID);
    };
    EXPECT_FALSE(fs::exists(folder / "a/series-999-dose"));
    EXPECT_NE(uidOf(dicomFiles(folder / "a").at(0)), uidOf(dicomFiles(study().out).at(0)));
}

TEST(PhantomStudy, IsNotWrittenOverAnythingElse)
{
    support::TemporaryFolder folder;
    std::ofstream(folder / "note.txt") << "mine";
    NoProgress progress;
    EXPECT_THROW(writeStudy(folder.path(), smallOptions(), progress), Error);
    EXPECT_TRUE(dicomFiles(folder.path()).empty());
}

}  // namespace
}  // namespace vicon::phantom
