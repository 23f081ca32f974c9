// Lumens that other programs wrote: write-masks writes them, by hand and by the formats' own pages.
#include "vicon/ingest/mask_file.h"

#include <gmock/gmock.h>
#include <itkImage.h>
#include <itkImageFileReader.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <fstream>

#include "vicon/core/error.h"
#include "vicon/scan_files/volume_file.h"
#include "vicon/support/support.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

using support::TemporaryFolder;
using testing::HasSubstr;

constexpr double kLargest_mvoxel = 4000;

/// A hook that no turning round makes the same, in a lattice that leans against the patient's axes.
InsideVolume hook()
{
    Grid grid;
    grid.size = {19, 22, 25};
    grid.origin_mm = {-31, 12, -700};
    grid.spacing_mm = {1.5, 1.25, 2};
    const double lean = 0.1;
    grid.axis = {Vector3{std::cos(lean), std::sin(lean), 0}, {-std::sin(lean), std::cos(lean), 0}, {0, 0, 1}};
    InsideVolume mask(grid);
    for (int k = 3; k < 20; ++k)
        for (int j = 4; j < 7; ++j)
            for (int i = 2; i < 5; ++i)
                mask.at({i, j, k}) = 1;
    for (int j = 4; j < 15; ++j)
        mask.at({3, j, 19}) = mask.at({3, j, 18}) = 2;
    for (int i = 3; i < 11; ++i)
        mask.at({i, 14, 19}) = 1;
    return mask;
}

/// Writes a set of files from a mask.
void writeMasks(const InsideVolume& mask, const fs::path& folder, const std::string& set)
{
    fs::create_directories(folder);
    scan_files::writeVolume(folder / "mask.mha", mask, scan_files::Packing::zlib);
    const auto done = support::runCommand(std::string(VICON_WRITE_MASKS) + " " + (folder / "mask.mha").string() + " " +
                                          folder.string() + " " + set);
    ASSERT_EQ(done.exit_code, 0) << done.output;
    fs::remove(folder / "mask.mha");
}

/// Voxels of one that are not at the same place in the other, both ways.
std::size_t differences(const InsideVolume& a, const InsideVolume& b)
{
    std::size_t count = 0;
    for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)})
        for (std::size_t n = 0; n < from->voxels.size(); ++n)
            if (from->voxels[n] && !to->valueOr(to->grid.indexAt(from->grid.pointAt(from->grid.indexOf(n))), 0))
                ++count;
    return count;
}

MaskFile readIt(const fs::path& file, std::optional<int> label = {})
{
    NoProgress quiet;
    return readMask(file, label, kLargest_mvoxel, quiet);
}

/// What refusing a file says; empty where it is not refused.
std::string refusalOf(const fs::path& file, std::optional<int> label = {})
try {
    readIt(file, label);
    return {};
} catch (const Error& e) {
    EXPECT_EQ(e.subject(), file.string());
    EXPECT_FALSE(e.remedy().empty()) << e.what();
    return std::string(nameOf(e.code())) + ": " + e.what();
}

TEST(MaskFiles, OfEveryFormOrderAndHandednessAreTheSameLumen)
{
    const TemporaryFolder folder;
    writeMasks(hook(), folder / "proper", "proper");
    std::size_t read = 0;
    for (const auto& entry : fs::directory_iterator(folder / "proper")) {
        if (entry.path().extension() == ".zraw")
            continue;
        SCOPED_TRACE(entry.path().filename());
        const MaskFile mask = readIt(entry.path());
        EXPECT_EQ(differences(mask.mask, hook()), 0U);
        EXPECT_EQ(mask.label, 1);
        EXPECT_EQ(mask.sha256.size(), 64U);
        ++read;
    }
    EXPECT_EQ(read, 48U * 6 + 10);
}

/// By a reader that is not ours.
InsideVolume readByItk(const fs::path& file)
{
    using Image = itk::Image<float, 3>;
    auto reader = itk::ImageFileReader<Image>::New();
    reader->SetFileName(file.string());
    if (const std::string kind = file.extension(); kind == ".nrrd")
        reader->SetImageIO(itk::NrrdImageIO::New());
    else if (kind == ".mha" || kind == ".mhd")
        reader->SetImageIO(itk::MetaImageIO::New());
    else
        reader->SetImageIO(itk::NiftiImageIO::New());
    reader->Update();
    const Image& image = *reader->GetOutput();
    Grid grid;
    grid.origin_mm = {image.GetOrigin()[0], image.GetOrigin()[1], image.GetOrigin()[2]};
    for (unsigned a = 0; a < 3; ++a) {
        grid.size[a] = int(image.GetLargestPossibleRegion().GetSize(a));
        grid.spacing_mm[a] = image.GetSpacing()[a];
        grid.axis[a] = {image.GetDirection()[0][a], image.GetDirection()[1][a], image.GetDirection()[2][a]};
    }
    InsideVolume mask(grid);
    std::transform(image.GetBufferPointer(), image.GetBufferPointer() + grid.voxelCount(), mask.voxels.begin(),
                   [](float value) { return std::uint8_t(value != 0); });
    return mask;
}

TEST(MaskFiles, AreReadAsItkReadsThem)
{
    const TemporaryFolder folder;
    writeMasks(hook(), folder / "proper", "proper");
    for (const auto& entry : fs::directory_iterator(folder / "proper"))
        // ITK 5.2 takes the coordinates of a NRRD in left, anterior, superior for something else.
        if (entry.path().extension() != ".zraw" && !entry.path().filename().string().starts_with("nrrd-las")) {
            EXPECT_EQ(differences(readIt(entry.path()).mask, readByItk(entry.path())), 0U) << entry.path().filename();
        }
}

TEST(MaskFiles, AreReadOneLabelOfSeveralAndListThemAll)
{
    const TemporaryFolder folder;
    writeMasks(hook(), folder.path(), "hostile two-labels");
    const fs::path file = folder / "two-labels.nrrd";
    EXPECT_THAT(refusalOf(file), HasSubstr("wrong_use"));
    EXPECT_THAT(refusalOf(file), HasSubstr("has several labels: 1, 7"));
    EXPECT_THAT(refusalOf(file, 3), HasSubstr("has no label 3; it has 1, 7"));
    const auto count = [](const InsideVolume& mask) {
        return std::count_if(mask.voxels.begin(), mask.voxels.end(), [](auto v) { return v != 0; });
    };
    EXPECT_EQ(count(readIt(file, 1).mask) + count(readIt(file, 7).mask), count(hook()));
}

constexpr std::size_t kLongestLine = 1000;

struct Refused {
    const char* name;
    const char* words;
};

constexpr Refused kRefused[] = {
    {"cut-off.nii", "cut off"},
    {"too-long.nii", "more bytes than its header says"},
    {"header-only.nii", "no mask that can be read"},
    {"packed-cut-off.nii.gz", "cut off"},
    {"packed-check-sum.nii.gz", "damaged"},
    {"packed-damaged.nii.gz", "damaged"},
    {"bomb.nii.gz", "more bytes than its header says"},
    {"claims-much.nii.gz", "import.largest_volume_mvoxel"},
    {"claims-more.nii", "cut off"},
    {"negative-size.nii", "-4 voxels along an axis"},
    {"offset.nii", "begin where none can"},
    {"offset-inside-header.nii", "begin where none can"},
    {"no-place.nii", "no place in the patient"},
    {"two-places.nii", "two different places"},
    {"sheared.nii", "not orthogonal"},
    {"colour.nii", "no single numbers"},
    {"nowhere.nii", "cannot be"},
    {"fractions.nii", "no labels"},
    {"image.nrrd", "an image, no mask"},
    {"empty.nii", "is empty"},
    {"unknown-space.nrrd", "its space is 'scanner-xyz'"},
    {"long-space.nrrd", "its space is '\uFFFD\\x1b"},
    {"no-origin.nrrd", "no 'space origin' of 3 numbers"},
    {"detached.nrrd", "do not follow its header"},
    {"skipping.nrrd", "do not follow its header"},
    {"said-twice.nrrd", "something twice"},
    {"text.nrrd", "encoded as 'ascii'"},
    {"negative-size.nrrd", "0 voxels along an axis"},
    {"no-end.nrrd", "its header has no end"},
    {"no-numbers.nrrd", "no 'sizes' of 3 numbers"},
    {"cut-off.mha", "cut off"},
    {"too-long.mha", "more bytes than its header says"},
    {"claims-much.mha", "import.largest_volume_mvoxel"},
    {"claims-more.mha", "cut off"},
    {"elsewhere.mhd", "not in a file beside it"},
    {"above.mhd", "not in a file beside it"},
    {"list.mhd", "not in a file beside it"},
    {"pattern.mhd", "not in a file beside it"},
    {"missing.mhd", "not in a file beside it"},
    {"name-too-long.mhd", "not in a file beside it"},
    {"channels.mha", "one volume of three dimensions"},
    {"long-line.mha", "its header has no end"},
    {"text.txt", "no mask that can be read"},
    {"nothing.nii", "no mask that can be read"},
};

TEST(MaskFiles, ThatAreDamagedOrMadeToHarmAreRefusedWithOneLineEach)
{
    const TemporaryFolder folder;
    writeMasks(hook(), folder.path(), "hostile");
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(folder.path()))
        files += entry.is_regular_file() ? 1 : 0;
    EXPECT_EQ(files, std::size(kRefused) + 1) << "two-labels.nrrd has a test of its own";
    for (const Refused& refused : kRefused) {
        const std::string said = refusalOf(folder / refused.name);
        EXPECT_THAT(said, HasSubstr(refused.words)) << refused.name;
        EXPECT_THAT(said, HasSubstr("bad_input")) << refused.name;
        EXPECT_THAT(said, testing::Not(HasSubstr("\n"))) << refused.name;
        EXPECT_LT(said.size(), kLongestLine) << refused.name;
    }
    EXPECT_THAT(refusalOf(folder / "is-not-there.nii"), HasSubstr("not_found"));
}

TEST(SegmentationObjects, AreTheSameLumenHoweverTheirFramesAreStored)
{
    const TemporaryFolder folder;
    scan_files::writeVolume(folder / "mask.mha", hook(), scan_files::Packing::zlib);
    const auto done = support::runCommand(std::string(VICON_WRITE_SEGMENTATIONS " ") + (folder / "mask.mha").string() +
                                          " " + folder.path().string());
    ASSERT_EQ(done.exit_code, 0) << done.output;
    std::size_t read = 0;
    for (const auto& entry : fs::directory_iterator(folder.path())) {
        if (!entry.path().filename().string().starts_with("proper-"))
            continue;
        const MaskFile mask = readIt(entry.path());
        EXPECT_EQ(differences(mask.mask, hook()), 0U) << entry.path();
        EXPECT_EQ(mask.frame_of_reference_uid, "1.2.826.0.1.3680043.9.1");
        EXPECT_EQ(mask.notes.empty(), entry.path().stem() != "proper-fractional");
        ++read;
    }
    EXPECT_EQ(read, 6U);
    constexpr Refused kWrong[] = {
        {"two-segments", "has several labels: 1 'Colon', 2 'Liver'"},
        {"fewer-pixels", "more or fewer pixels"},
        {"more-pixels", "more or fewer pixels"},
        {"more-frames", "of each frame"},
        {"large", "import.largest_volume_mvoxel"},
        {"uneven", "do not lie evenly"},
        {"leaning", "straight above each other"},
        {"empty", "is empty"},
        {"without-orientation", "of each frame"},
        {"other-class", "no segmentation"},
        {"other-type", "neither a BINARY nor a FRACTIONAL"},
        {"compressed", "compressed"},
        {"cut-off", ""},
        {"cut-off-early", ""},
    };
    for (const Refused& wrong : kWrong) {
        const std::string said = refusalOf(folder / (wrong.name + std::string(".dcm")));
        EXPECT_THAT(said, HasSubstr(wrong.words)) << wrong.name;
        EXPECT_NE(said, "") << wrong.name;
    }
    EXPECT_LT(differences(readIt(folder / "two-segments.dcm", 2).mask, hook()), differences({}, hook()));
}

/// Whatever is cut off or changed anywhere in a header: an error or a mask, and nothing else.
TEST(MaskFiles, WithAnyByteOfTheirHeaderChangedAreReadOrRefused)
{
    const TemporaryFolder folder;
    writeMasks(hook(), folder.path(), "proper nifti-both nrrd-short. meta-raw");
    for (const char* name : {"nifti-both.nii", "nrrd-short.nrrd", "meta-raw.mha"}) {
        std::string bytes;
        {
            std::ifstream in(folder / name, std::ios::binary);
            bytes.assign(std::istreambuf_iterator<char>(in), {});
        }
        const fs::path changed = folder / ("changed-" + std::string(name));
        for (std::size_t at = 0; at < 600; at += 5)
            for (const char other : {'\0', '\xff', '9'}) {
                std::string some = bytes;
                some[at] = other;
                std::ofstream(changed, std::ios::binary | std::ios::trunc) << some;
                refusalOf(changed);
            }
    }
}

}  // namespace
}  // namespace vicon::ingest
