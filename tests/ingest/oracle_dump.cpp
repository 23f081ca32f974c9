// What VICON and ITK read of DICOM, as plain files for `import-oracle`, which compares them with what pydicom reads.
//   oracle_dump generate OUT    series of every encoding, orientation and rescale, one below OUT each; as slices, and
//                               as frames of one object
//   oracle_dump read IN OUT     OUT/N.mha: the volumes that VICON makes of IN; OUT/N.json: their files, and which slice
//                               of ITK's, OUT/itk/M.mha, is which file
#include <itkGDCMImageIO.h>
#include <itkImage.h>
#include <itkImageFileReader.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "dicom_writer.h"
#include "transcode.h"
#include "vicon/cases/case_store.h"
#include "vicon/core/error.h"
#include "vicon/ingest/import.h"
#include "vicon/ingest/load_scan.h"
#include "vicon/scan_files/volume_file.h"

namespace fs = std::filesystem;
using namespace vicon;

namespace {

struct Orientation {
    const char* name;
    Vector3 row, column, step_mm;
};
const double kHalf = std::sqrt(0.5);
const Orientation kOrientations[] = {
    {"axial", {1, 0, 0}, {0, 1, 0}, {0, 0, 2}},         {"axial-downwards", {1, 0, 0}, {0, 1, 0}, {0, 0, -2}},
    {"prone", {-1, 0, 0}, {0, -1, 0}, {0, 0, 2}},       {"coronal", {1, 0, 0}, {0, 0, -1}, {0, 1.5, 0}},
    {"sagittal", {0, 1, 0}, {0, 0, -1}, {-1.25, 0, 0}}, {"oblique", {kHalf, kHalf, 0}, {0, 0, -1}, {kHalf, -kHalf, 0}},
};

struct Rescale {
    const char* name;
    double slope, intercept;
    int bits_stored;
    bool is_signed;
};
const Rescale kRescales[] = {
    {"unsigned12", 1, -1024, 12, false},  {"signed16", 1, 0, 16, true},   {"signed12", 1, -100, 12, true},
    {"fraction", 0.25, -1024, 16, false}, {"fewer", 3, -1200, 10, false},
};

/// Every encoding of these files, in a folder for each.
void encode(const std::vector<fs::path>& files, const fs::path& out, const std::string& name)
{
    for (const char* encoding : test::kEncodings) {
        const fs::path folder = out / (name + "_" + encoding);
        fs::create_directories(folder);
        for (const fs::path& file : files)
            test::transcode(file, folder / file.filename(), encoding);
    }
}

/// All frames, not in the order of their places.
std::vector<int> shuffled(int frames)
{
    std::vector<int> order;
    for (int n = 0; n < frames; ++n)
        order.push_back(n % 2 ? n / 2 : frames - 1 - n / 2);
    return order;
}

void generate(const fs::path& out)
{
    int number = 0;
    for (const Orientation& orientation : kOrientations)
        for (const Rescale& rescale : kRescales) {
            test::SeriesSpec spec;
            spec.study_uid += "." + std::to_string(++number);
            spec.series_uid = spec.study_uid + ".1";
            spec.row = orientation.row;
            spec.column = orientation.column;
            spec.step_mm = orientation.step_mm;
            spec.columns = 18;
            spec.row_mm = 1.5;
            spec.slope = rescale.slope;
            spec.intercept = rescale.intercept;
            spec.bits_stored = rescale.bits_stored;
            spec.high_bit = rescale.bits_stored - 1;
            spec.is_signed = rescale.is_signed;
            const std::string name = std::string(orientation.name) + "_" + rescale.name;
            encode(test::writeSeries(out / "plain", spec), out, name);
            encode({test::writeEnhanced(out / "plain" / "frames.dcm", spec, shuffled(spec.slices))}, out,
                   name + "_frames");
            fs::remove_all(out / "plain");
        }
}

Volume<float> readWithItk(const fs::path& file)
{
    using Image = itk::Image<float, 3>;
    const auto reader = itk::ImageFileReader<Image>::New();
    reader->SetImageIO(itk::GDCMImageIO::New());
    reader->SetFileName(file.string());
    reader->Update();
    const Image& image = *reader->GetOutput();
    Volume<float> volume;
    for (unsigned a = 0; a < 3; ++a) {
        volume.grid.size[a] = int(image.GetLargestPossibleRegion().GetSize(a));
        volume.grid.spacing_mm[a] = image.GetSpacing()[a];
        const auto& direction = image.GetDirection();
        volume.grid.axis[a] = {direction(0, a), direction(1, a), direction(2, a)};
    }
    volume.grid.origin_mm = {image.GetOrigin()[0], image.GetOrigin()[1], image.GetOrigin()[2]};
    const float* first = image.GetBufferPointer();
    volume.voxels.assign(first, first + volume.grid.voxelCount());
    return volume;
}

/// False for an encoding that ITK does not know.
bool convertWithItk(const fs::path& from, const fs::path& to)
{
    try {
        scan_files::writeVolume(to, readWithItk(from), scan_files::Packing::raw);
        return true;
    } catch (const itk::ExceptionObject&) {
        return false;
    }
}

void read(const fs::path& in, const fs::path& out)
{
    NoProgress quiet;
    CaseStore store(out / "store");
    fs::create_directories(out / "itk");
    ingest::importPaths(store, {in}, {}, quiet);
    int scans = 0, files = 0;
    for (const CaseRecord& a_case : store.cases())
        for (const ScanRecord& scan : store.scans(a_case.id)) {
            if (scan.role == ScanRole::refused)
                continue;
            const fs::path folder = store.scanFolder(scan.case_id, scan.id) / "dicom";
            nlohmann::json about = {
                {"ingest", scan.ingest}, {"lossy", scan.series.lossy}, {"files", nlohmann::json::array()}};
            for (const auto& entry : fs::directory_iterator(folder)) {
                const fs::path itk = out / "itk" / (std::to_string(files++) + ".mha");
                const bool known = convertWithItk(entry.path(), itk);
                about["files"].push_back({{"dicom", entry.path().string()}, {"itk", known ? itk.string() : ""}});
            }
            const std::string name = std::to_string(scans++);
            scan_files::writeVolume(out / (name + ".mha"), ingest::loadScan(folder, {}, quiet),
                                    scan_files::Packing::raw);
            std::ofstream(out / (name + ".json")) << about.dump();
        }
}

}  // namespace

int main(int count, char** arguments)
try {
    const std::string what = count > 2 ? arguments[1] : "";
    if (what == "generate" && count == 3)
        generate(arguments[2]);
    else if (what == "read" && count == 4)
        read(arguments[2], arguments[3]);
    else
        return 2;
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
