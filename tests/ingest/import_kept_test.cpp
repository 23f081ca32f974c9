// What was stored stays: no later import loses an object, and what was lost comes back.
#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "import_fixture.h"

namespace fs = std::filesystem;
using namespace vicon;
using namespace vicon::test;
using Kind = ingest::ImportLine::Kind;

namespace {

class KeptObjects : public Import {
protected:
    fs::path storedFile(const std::string& sop_uid)
    {
        const InstanceRecord row = store.findInstance(sop_uid).value();
        return store.scanFolder(row.case_id, row.scan_id) / "dicom" / row.file;
    }
    /// The scan's row, and its instances with the bytes of their files.
    std::map<std::string, std::string> stateOfScan(const ScanRecord& scan)
    {
        std::map<std::string, std::string> state;
        for (const auto& [key, value] : stateOf(store))
            if (key.find(scan.id) != std::string::npos || value.starts_with(scan.id))
                state[key] = value;
        return state;
    }
    ScanRecord importFirst(const SeriesSpec& spec)
    {
        writeSeries(folder / "first", spec);
        import({folder / "first"});
        return onlyScan();
    }
    ingest::ImportReport importAnother(const SeriesSpec& first)
    {
        SeriesSpec small = secondSeries(first, "2");
        small.columns = small.rows = 8;
        writeSeries(folder / "another", small);
        return import({folder / "another"});
    }
    void flipLastByte(const fs::path& file)
    {
        std::string bytes = readFile(file);
        bytes.back() = char(bytes.back() ^ 0x55);
        std::ofstream(file, std::ios::binary) << bytes;
    }
    static std::string withOtherMetaHeader(const fs::path& file)
    {
        return support::runCommand("dcmconv +ti " + file.string() + " " + file.string()).output;
    }
};

TEST_F(KeptObjects, AScanThatANewLimitRefusesStaysWhenItsStudyGrows)
{
    const SeriesSpec spec;
    const ScanRecord first = importFirst(spec);
    const auto before = stateOfScan(first);
    options.largest_matrix = 8;
    const auto report = importAnother(spec);
    EXPECT_EQ(report.scans_stored, 1) << lines(report);
    EXPECT_TRUE(says(report, Kind::refused, "12 of its stored images cannot be used (it claims to have 16 x 16"))
        << lines(report);
    EXPECT_EQ(stateOfScan(first), before);
    EXPECT_EQ(store.scans(first.case_id).size(), 2u);
}

TEST_F(KeptObjects, AScanStaysWhenSomeOfItsFilesCannotBeRead)
{
    const SeriesSpec spec;
    const ScanRecord first = importFirst(spec);
    for (int slice = 3; slice < 12; ++slice)
        fs::resize_file(storedFile(spec.sopUid(slice)), 200);
    const auto before = stateOfScan(first);
    const auto report = importAnother(spec);
    EXPECT_TRUE(says(report, Kind::refused, "9 of its stored images cannot be used (")) << lines(report);
    EXPECT_EQ(stateOfScan(first), before) << "neither its role, its words nor its rows";
    import({folder / "first"});
    EXPECT_EQ(load(store.requireScan(first.case_id, first.id)).grid.size[2], 12) << "mended";
}

TEST_F(KeptObjects, LateSlicesStandBesideAScanThatCannotBeReadUntilItCan)
{
    SeriesSpec spec, longer = spec;
    longer.slices = 24;
    const ScanRecord first = importFirst(spec);
    const fs::path lost = storedFile(spec.sopUid(5));
    fs::rename(lost, folder / "aside");
    const auto before = stateOfScan(first);
    std::vector<int> late(12);
    std::iota(late.begin(), late.end(), 12);
    for (const fs::path& file : writeSeries(folder / "late", longer, late))
        if (file.filename() != "20.dcm")
            import({file});  // one by one
    import({folder / "late"});
    EXPECT_EQ(stateOfScan(first), before);
    EXPECT_EQ(store.scans(first.case_id).size(), 2u);
    fs::rename(folder / "aside", lost);
    import({folder / "late"});
    EXPECT_EQ(store.instances(first.case_id, first.id).size(), 24u);
    EXPECT_EQ(onlyScan().id, first.id) << "one scan";
}

TEST_F(KeptObjects, AnObjectThatSharesItsFramesWithAnotherIsInAScan)
{
    SeriesSpec spec, second = spec;
    second.sop_suffix = ".2";
    std::vector<int> order(15);
    std::iota(order.begin(), order.begin() + 12, 0);
    std::iota(order.begin() + 12, order.end(), 0);
    std::vector<std::string> kernels(12, "B30f");
    kernels.resize(15, "B70f");
    const fs::path both = writeEnhanced(folder / "both.dcm", spec, order, kernels);
    const fs::path rest =
        writeEnhanced(folder / "rest.dcm", second, {3, 4, 5, 6, 7, 8, 9, 10}, std::vector<std::string>(8, "B70f"));
    const auto report = import({both, rest});
    EXPECT_TRUE(report.not_stored.empty()) << lines(report);
    ASSERT_TRUE(store.findInstance(spec.series_uid + ".1"));
    ASSERT_TRUE(store.findInstance(spec.series_uid + ".1.2")) << lines(report);
    EXPECT_TRUE(says(report, Kind::repaired, "3 frames that belong to another stack are not used")) << lines(report);
    EXPECT_TRUE(says(report, Kind::kept, "8 slices, 2.00 mm apart")) << lines(report);
    EXPECT_TRUE(says(report, Kind::kept, "its images share a stack with those of another scan")) << lines(report);
    // In parts, in the other order, and again, it ends in the same state.
    CaseStore parts(folder / "parts");
    for (const fs::path& file : {rest, both, rest})
        ingest::importPaths(parts, {file}, options, quiet);
    EXPECT_EQ(stateOf(parts), stateOf(store));
}

TEST_F(KeptObjects, WhatNoScanTakesIsSaidNotToBeStored)
{
    // A chain: each object shares a stack with the next, more often than scans are made of such.
    std::vector<fs::path> files;
    constexpr int kLinks = 60;
    for (int n = 0; n < kLinks; ++n) {
        SeriesSpec link;
        link.sop_suffix = "." + std::to_string(n);
        link.pixel_mm = link.row_mm = 1;
        std::vector<std::string> kernels(10, "K" + std::to_string(n));
        kernels.resize(20, "K" + std::to_string(n + 1));
        std::vector<int> order(20);
        std::iota(order.begin(), order.end(), n % 2 == 0 ? 0 : 20);
        files.push_back(writeEnhanced(folder / "chain" / (std::to_string(n) + ".dcm"), link, order, kernels));
    }
    const auto report = import({folder / "chain"});
    std::set<fs::path> left(report.not_stored.begin(), report.not_stored.end());
    for (int n = 0; n < kLinks; ++n)
        EXPECT_NE(left.contains(files[std::size_t(n)]),
                  store.findInstance(SeriesSpec{}.series_uid + ".1." + std::to_string(n)).has_value())
            << "stored or left, not both: " << n;
    EXPECT_FALSE(left.empty()) << lines(report);
}

TEST_F(KeptObjects, ALostOrDamagedFileIsMendedByItsObjectWithAnotherMetaHeader)
{
    const SeriesSpec spec;
    const ScanRecord first = importFirst(spec);
    const auto again = writeSeries(folder / "again", spec);
    for (const fs::path& file : again)
        ASSERT_EQ(withOtherMetaHeader(file), "");
    fs::remove(storedFile(spec.sopUid(4)));
    flipLastByte(storedFile(spec.sopUid(7)));
    const auto report = import({folder / "again"});
    EXPECT_EQ(report.refused, 0) << lines(report);
    EXPECT_TRUE(says(report, Kind::repaired, "2 stored images were lost or damaged")) << lines(report);
    for (const int slice : {4, 7}) {
        const InstanceRecord row = store.findInstance(spec.sopUid(slice)).value();
        EXPECT_EQ(row.scan_id, first.id);
        EXPECT_EQ(sha256OfFile(storedFile(spec.sopUid(slice))), row.sha256);
        EXPECT_EQ(row.sha256, sha256OfFile(again[std::size_t(slice)]));
    }
    const auto after = stateOf(store);
    const auto once_more = import({folder / "first", folder / "again"});
    EXPECT_EQ(once_more.scans_unchanged, 1) << lines(once_more);
    EXPECT_EQ(stateOf(store), after);
}

TEST_F(KeptObjects, ADamagedFileIsMendedByTheSameBytes)
{
    const SeriesSpec spec;
    importFirst(spec);
    const auto before = stateOf(store);
    flipLastByte(storedFile(spec.sopUid(7)));
    import({folder / "first"});
    EXPECT_EQ(stateOf(store), before);
}

TEST_F(KeptObjects, BytesBehindTheEndMakeNoOtherObject)
{
    const SeriesSpec spec;
    importFirst(spec);
    const auto before = stateOf(store);
    for (const std::string& behind :
         {std::string("a note of the archive"), std::string(64, '\xff'), std::string(8, '\0')}) {
        fs::remove_all(folder / "again");
        append(writeSeries(folder / "again", spec).at(4), behind);
        const auto report = import({folder / "again"});
        EXPECT_EQ(report.refused, 0) << lines(report);
        EXPECT_EQ(stateOf(store), before);
    }
}

TEST_F(KeptObjects, OtherContentDoesNotReplaceAFileThatIsWhole)
{
    SeriesSpec spec, other = spec;
    importFirst(spec);
    const auto before = stateOf(store);
    other.densities = [](Point3 p) { return 9 * p.x; };
    writeSeries(folder / "other", other, {4});
    const auto report = import({folder / "other"});
    EXPECT_TRUE(says(report, Kind::refused, "with other content is stored; the first is kept")) << lines(report);
    EXPECT_EQ(report.not_stored.size(), 1u);
    EXPECT_EQ(stateOf(store).at("instance " + spec.sopUid(4)), before.at("instance " + spec.sopUid(4)));
}

}  // namespace
