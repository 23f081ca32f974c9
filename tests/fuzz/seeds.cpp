// Writes what the harnesses begin with: fuzz_seeds OUT [FILE...]. OUT/NAME is the corpus of a harness; the compressed
// frames of the given DICOM files become streams too.
#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "dicom_writer.h"
#include "stream_encodings.h"
#include "transcode.h"
#include "vicon/cases/case_store.h"
#include "vicon/cases/findings.h"
#include "vicon/cases/marker.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/ingest/import.h"
#include "vicon/report/report_objects.h"
#include "vicon/scan_files/cells_file.h"
#include "vicon/scan_files/skeleton_file.h"
#include "vicon/scan_files/subdivision_file.h"
#include "vicon/scan_files/volume_file.h"

namespace fs = std::filesystem;
using namespace vicon;

namespace {

void save(const fs::path& file, const std::string& bytes)
{
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

/// One small image in every encoding, and a multi-frame one.
void writeObjects(const fs::path& out)
{
    test::SeriesSpec spec;
    spec.slices = 3;
    const fs::path plain = test::writeSeries(out / "object", spec, {0}).front();
    for (const char* syntax : test::kEncodings)
        test::transcode(plain, out / "object" / syntax, syntax);
    test::writeEnhanced(out / "object" / "enhanced", spec, {0, 1, 2});
    spec.bits_allocated = spec.bits_stored = 8;
    spec.high_bit = 7;
    test::writeSeries(out / "object" / "bytes", spec, {0});
    for (const auto& entry : fs::recursive_directory_iterator(out / "object"))
        if (entry.is_regular_file())
            save(out / "structure" / entry.path().filename(), readFile(entry.path()));
}

void writeVolumes(const fs::path& out)
{
    Grid grid;
    grid.size = {4, 3, 5};
    grid.spacing_mm = {0.5, 0.5, 1};
    fs::create_directories(out / "volume");
    scan_files::writeVolume(out / "volume" / "densities", HuVolume(grid, 40), scan_files::Packing::raw);
    scan_files::writeVolume(out / "volume" / "labels.mha", InsideVolume(grid, 1), scan_files::Packing::zlib);
    scan_files::writeVolume(out / "volume" / "field", FieldVolume(grid, 1.5F), scan_files::Packing::raw);
}

/// What the masks of other programs are made from: not alike from any two sides, with room around.
void writeLumen(const fs::path& out)
{
    Grid grid;
    grid.size = {7, 6, 8};
    grid.spacing_mm = {1.5, 1.25, 2};
    InsideVolume lumen(grid);
    for (int k = 1; k < 7; ++k)
        lumen.at({2, 1, k}) = lumen.at({3, 1, k}) = 1;
    for (int j = 1; j < 4; ++j)
        lumen.at({2, j, 6}) = 1;
    scan_files::writeVolume(out / "lumen.mha", lumen, scan_files::Packing::zlib);
}

Skeleton line()
{
    Skeleton skeleton;
    skeleton.pieces.push_back({false, {{{0, 0, 0}, 0, 5}, {{0, 0, 3}, 3, 5}}});
    skeleton.pieces.push_back({true, {{{0, 0, 3}, 3, 0}, {{0, 0, 9}, 9, 0}}});
    return skeleton;
}

void writeSurfaces(const fs::path& out)
{
    const fs::path folder = out / "poly_data";
    fs::create_directories(folder);
    scan_files::writeSkeleton(folder / "skeleton.vtp", line());
    SkeletonTree tree;
    tree.branches.push_back({-1, 0, line().pieces[0].points});
    tree.branches.push_back({0, 1, line().pieces[1].points});
    scan_files::writeSkeletonTree(folder / "tree.vtp", tree);
    scan_files::writeSkeletonVoxels(folder / "voxels.vtp", {{{0, 0, 0}, {0, 0, 1}, {0, 1, 2}}});
    CellSurface surface;
    surface.points_mm = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    surface.normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    surface.triangles = {0, 1, 2, 1, 3, 2};
    surface.segment = {1, 2};
    scan_files::writeCells(folder / "cells.vtp", surface);
}

void writeJson(const fs::path& out)
{
    NoProgress quiet;
    CaseStore store(out / "store");
    test::writeSeries(out / "study", {});
    ingest::importPaths(store, {out / "study"}, {}, quiet);
    const ScanRecord scan = store.scans(store.cases().at(0).id).at(0);
    save(out / "scan_json" / "scan", readFile(store.scanFolder(scan.case_id, scan.id) / "scan.json"));
    Subdivision subdivision;
    subdivision.method = SubdivideMethod::thesis;
    subdivision.segments.push_back({1, 0, 30, 1000, 100, 50, 200, {0, 0, 0}, {9, 9, 9}});
    subdivision.portals.emplace_back();
    scan_files::writeSubdivision(out / "scan_json" / "subdivision", subdivision);
    for (const char* harness : {"scan_json", "corrections"})
        save(out / harness / "corrections", R"({"add":[[1,2,3]],"cut":[],"drop":[[4,5,6.5]]})");
    save(
        out / "bridge_reviews" / "two",
        R"({"bridges":[{"from_mm":[0,0,0],"to_mm":[0,0,9.5],"verdict":"confirmed","by":"a","at":"2026-01-02T03:04:05Z"},)"
        R"({"from_mm":[1,2,3],"to_mm":[4,5,6],"verdict":"rejected","by":"b","at":""}]})");
    save(out / "given_lumen" / "one",
         R"({"form":"NIfTI","sha256":"0123456789abcdef","label":2,"gas_or_fluid":0.91,"by":"a","at":"2026-01-02",)"
         R"("mask":"lumen-0123456789ab.mha","mask_sha256":"fedcba9876543210"})");
    save(out / "web" / "parts", "?--b\r\nContent-Type: application/dicom\r\n\r\none\r\n--b\r\n\r\ntwo\r\n--b--");
    save(out / "web" / "matches",
         R"(?[{"0020000D":{"vr":"UI","Value":["1.2","1.3"]},"00100010":{"vr":"PN","Value":[{"Alphabetic":"A^B"}]}}])");
    save(out / "scan_json" / "segment",
         R"({"verdict":"colon","confidence":0.9,"reason":"r","organ":"colon","noise_hu":12.5,"plan":{},)"
         R"("bridges":[{"from_mm":[0,0,0],"to_mm":[0,0,9],"length_mm":9,"confidence":0.5}],"method":"thesis",)"
         R"("triangles":7,"length_mm":1500,"size":[4,4,4],"acquired_size":[4,4,4],"acquired_spacing_mm":[1,1,1],)"
         R"("parts":[{"name":"rectum","from_mm":0,"to_mm":150}]})");
    Marker marker;
    marker.id = "m1";
    marker.scan_id = scan.id;
    marker.note = "a note";
    save(out / "markers" / "one", toJson(std::vector{marker}).dump(2));
    save(out / "markers" / "more",
         R"({"markers":[{"position_mm":[1,2,3],"color":"red","note":"n","part":"rectum","pair":"m2","size":)"
         R"({"longest_mm":6,"from_mm":[0,0,0],"to_mm":[0,0,6]},"density":{"mean_hu":30},"view":{"eye_mm":[0,0,0]},)"
         R"("else":{"a":[1]}}]})");
}

/// VICON's own structured report, of a study with two findings and all that may be said of it.
void writeReport(const fs::path& out)
{
    CaseStore store(out / "store");
    const std::string id = store.cases().at(0).id, scan_id = store.scans(id).at(0).id;
    const auto mark = [&](Point3 at, double station_mm) {
        Marker marker{.scan_id = scan_id, .position_mm = at, .station_mm = station_mm};
        marker.part = ColonPart::sigmoid;
        marker.density = DensitySample{.centre_mm = at, .voxels = 40, .mean_hu = 41};
        marker.size = MarkerSize{.straight_mm = 7.3};
        return store.saveMarker(id, marker).id;
    };
    const Finding polyp{.markers = {mark({-10, -5, -12}, 300), mark({-2, -8, -4}, 310)},
                        .morphology = Morphology::flat,
                        .confidence = Confidence::low,
                        .height_mm = 2.1,
                        .note = "a note"};
    const Finding mass{.kind = FindingKind::mass, .markers = {mark({-11, -3, -16}, 900)}};
    editFindings(store, id, {{std::nullopt, polyp}, {std::nullopt, mass}});
    Assessment said{.indication = "why", .impression = "two findings", .preparation = Grade::good, .dose_mgy_cm = 300};
    said.extracolonic = {{"kidney", "cyst", ExtracolonicCategory::e1}};
    said.colon_category = {ColonCategory::c2a, "why", ColonCategory::c0};
    said.distension = {{scan_id, ColonPart::sigmoid, Distension::limited}};
    saveAssessment(store, id, assessmentOf(store, id), said);
    const ReadCase read = readCase(store, id);
    const ReportVersion version{.version = 1, .state = ReportState::final, .person = "reader", .digest = "d"};
    fs::create_directories(out / "prior_report");
    report::ShownScans scans(store, read);
    report::writeReportObjects(scans, {.read = read, .version = version, .kinds = {report::ObjectKind::measurements}},
                               out / "prior_report");
}

void writeTexts(const fs::path& out)
{
    save(out / "text" / "latin", "\2M\xfcller^J\xf6rg");
    save(out / "text" / "japanese",
         "\6Yamada^Tarou=\x1b$B;3ED\x1b(B^\x1b$BB@O:\x1b(B=\x1b$B$d$^$@\x1b(B^\x1b$B$?$m$&\x1b(B");
    save(out / "text" / "korean", "\x8Hong^Gildong=\x1b$)C\xfb\xf3^\x1b$)C\xd1\xce\xd4\xd7");
    save(out / "text" / "chinese", "\4Wang^XiaoDong=\xcd\xf5^\xd0\xa1\xb6\xab");
    save(out / "config" / "file",
         "[import]\nmin_slices = 12\nlargest_missing_gap_mm = 2.5\n[peers.pacs]\nhost = \"h\"\nport = 104\n"
         "ae_title = \"P\"\n[receive]\nallow = \"peers\"\nany_called_title = false\n");
    save(out / "config" / "assignment", "import.min_slices=12");
    save(out / "series" / "position", std::string("\6\0\x9-8\\-8\\6.5", 12));
    save(out / "series" / "kernel", std::string("\xa\xa\4B70f\x8\4\0032.5\xa\xb\3FFP", 20));
    save(out / "series" / "frames", std::string("\7\4\0032.5\xc\xa\4B70f", 13));
    save(out / "series" / "unknown", std::string("\xc\4\xc4nan ", 7));
}

/// The first frame of a compressed object; empty where there is none. The seeds' have one fragment each.
std::string firstFrame(DcmDataset& dataset, E_TransferSyntax syntax)
{
    DcmElement* element = nullptr;
    DcmPixelSequence* sequence = nullptr;
    DcmPixelItem* fragment = nullptr;
    Uint8* bytes = nullptr;
    dataset.findAndGetElement(DCM_PixelData, element);
    auto* pixels = dynamic_cast<DcmPixelData*>(element);
    if (!pixels || pixels->getEncapsulatedRepresentation(syntax, nullptr, sequence).bad() || !sequence ||
        sequence->getItem(fragment, 1).bad() || fragment->getUint8Array(bytes).bad())
        return {};
    return {reinterpret_cast<const char*>(bytes), fragment->getLength()};
}

/// What the harness of the guards is given: columns, rows, bits and encoding, then the stream.
void writeStream(const fs::path& out, const fs::path& file)
{
    DcmFileFormat format;
    if (format.loadFile(file.c_str()).bad())
        return;
    DcmDataset& dataset = *format.getDataset();
    const E_TransferSyntax syntax = dataset.getOriginalXfer();
    const auto known = std::find(std::begin(fuzz::kStreamEncodings), std::end(fuzz::kStreamEncodings),
                                 std::string_view(DcmXfer(syntax).getXferID()));
    const std::string stream = firstFrame(dataset, syntax);
    Uint16 columns = 0, rows = 0, bits = 0;
    dataset.findAndGetUint16(DCM_Columns, columns);
    dataset.findAndGetUint16(DCM_Rows, rows);
    dataset.findAndGetUint16(DCM_BitsAllocated, bits);
    if (stream.empty() || known == std::end(fuzz::kStreamEncodings))
        return;
    const std::string head{char(columns - 2), char(rows - 2), char(bits == 16),
                           char(known - std::begin(fuzz::kStreamEncodings))};
    save(out / "stream" / sha256(stream).substr(0, 16), head + stream);
}

}  // namespace

int main(int count, char** arguments)
try {
    if (count < 2)
        return 2;
    const fs::path out = arguments[1];
    writeObjects(out);
    writeVolumes(out);
    writeLumen(out);
    writeSurfaces(out);
    writeJson(out);
    writeReport(out);
    writeTexts(out);
    for (const auto& entry : fs::directory_iterator(out / "object"))
        writeStream(out, entry.path());
    for (int n = 2; n < count; ++n)
        writeStream(out, arguments[n]);
    return 0;
} catch (const Error& e) {
    std::fprintf(stderr, "%s: %s\n", e.subject().c_str(), e.what());
    return 1;
}
