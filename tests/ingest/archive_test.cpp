#include <archive.h>
#include <archive_entry.h>

#include <fstream>

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include "dicom_writer.h"
#include "store_fixture.h"

namespace fs = std::filesystem;
using namespace vicon;
using namespace vicon::test;
using Kind = ingest::ImportLine::Kind;

namespace {

class Archive : public StoreFixture {
protected:
    struct Entry {
        std::string name, content;
        bool link = false;
    };

    fs::path zip(const std::string& name, const std::vector<Entry>& entries)
    {
        archive* out = archive_write_new();
        archive_write_set_format_zip(out);
        archive_write_open_filename(out, (folder / name).c_str());
        for (const Entry& e : entries) {
            archive_entry* entry = archive_entry_new();
            archive_entry_set_pathname(entry, e.name.c_str());
            archive_entry_set_filetype(entry, e.link ? AE_IFLNK : AE_IFREG);
            if (e.link)
                archive_entry_set_symlink(entry, e.content.c_str());
            archive_entry_set_perm(entry, 0644);
            archive_entry_set_size(entry, e.link ? 0 : la_int64_t(e.content.size()));
            archive_write_header(out, entry);
            if (!e.link)
                archive_write_data(out, e.content.data(), e.content.size());
            archive_entry_free(entry);
        }
        archive_write_close(out);
        archive_write_free(out);
        return folder / name;
    }

    std::vector<Entry> seriesEntries()
    {
        std::vector<Entry> entries;
        for (const fs::path& file : writeSeries(folder / "series", {}))
            entries.push_back({"study/" + file.filename().string(), readFile(file), false});
        return entries;
    }

    std::size_t filesOutside()
    {
        std::size_t count = 0;
        for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
            count += entry.path().filename() == "evil.dcm" ? 1 : 0;
        return count;
    }
};

TEST_F(Archive, HoldsAScanAndNothingOfItLeavesTheStore)
{
    auto entries = seriesEntries();
    const std::string bytes = entries.front().content;
    for (const char* name : {"../../evil.dcm", "/tmp/evil.dcm", "a/../../evil.dcm", "..\\evil.dcm", "C:\\evil.dcm"})
        entries.push_back({name, bytes, false});
    entries.push_back({"link/evil.dcm", "/etc/passwd", true});
    const auto report = import({zip("study.zip", entries)});
    EXPECT_EQ(report.scans_stored, 1) << lines(report);
    EXPECT_EQ(report.refused, 6) << lines(report);
    EXPECT_TRUE(says(report, Kind::refused, "leads out"));
    EXPECT_EQ(filesOutside(), 0u);
    EXPECT_FALSE(fs::exists("/tmp/evil.dcm"));
    EXPECT_TRUE(fs::is_empty(store.folder() / "incoming"));
    EXPECT_EQ(load(onlyScan()).grid.size[2], 12);
}

TEST_F(Archive, GivesTheSameStateAsItsFolder)
{
    import({zip("study.zip", seriesEntries())});
    const auto zipped = onlyScan().ingest;
    EXPECT_EQ(import({folder / "series"}).scans_unchanged, 1);
    EXPECT_EQ(onlyScan().ingest, zipped);
}

TEST_F(Archive, LimitsOnCountAndSizeHold)
{
    const fs::path file = zip("study.zip", seriesEntries());
    options.archive_max_files = 5;
    EXPECT_TRUE(says(import({file}), Kind::refused, "import.archive_max_files"));
    options = {};
    options.archive_max_gb = 0.001;
    const fs::path bomb = zip("bomb.zip", {{"zeros", std::string(3000000, '\0'), false}});
    EXPECT_LT(fs::file_size(bomb), 100000u);
    EXPECT_TRUE(says(import({bomb}), Kind::refused, "import.archive_max_gb"));
    EXPECT_TRUE(fs::is_empty(store.folder() / "incoming"));
}

TEST_F(Archive, ManySmallOnesMayNotFillWhatOneMayNot)
{
    const std::string zeros(60'000'000, '\0');
    const fs::path one = zip("one.zip", {{"zeros", zeros, false}}), other = zip("other.zip", {{"zeros", zeros, false}});
    EXPECT_FALSE(says(import({one}), Kind::refused, "200 times its size"));
    const auto report = import({one, other});
    EXPECT_TRUE(says(report, Kind::refused, "200 times its size")) << lines(report);
}

TEST_F(Archive, DamageAndNestingCostLines)
{
    const fs::path inner = zip("inner.zip", seriesEntries());
    EXPECT_TRUE(
        says(import({zip("outer.zip", {{"inner.zip", readFile(inner), false}})}), Kind::refused, "inside a zip"));
    const std::string whole = readFile(inner);
    std::ofstream(folder / "cut.zip", std::ios::binary) << whole.substr(0, whole.size() / 2);
    const auto report = import({folder / "cut.zip"});
    EXPECT_GE(report.refused, 1) << lines(report);
}

TEST_F(Archive, ADicomdirNamesItsFiles)
{
    const auto files = writeSeries(folder / "disc/IMAGES", {});
    writeSeries(folder / "disc/OTHER", [] {
        SeriesSpec other;
        other.series_uid += ".7";
        return other;
    }());
    DcmFileFormat format;
    DcmDataset& dataset = *format.getDataset();
    for (const std::string& name : {std::string("images\\0.DCM"), std::string("IMAGES\\gone.dcm"),
                                    std::string("..\\..\\secret"), std::string(300, 'L')}) {
        DcmItem* record = nullptr;
        dataset.findOrCreateSequenceItem(DCM_DirectoryRecordSequence, record, -2);
        record->putAndInsertString(DCM_ReferencedFileID, name.c_str());
    }
    for (std::size_t n = 0; n < files.size(); ++n) {
        DcmItem* record = nullptr;
        dataset.findOrCreateSequenceItem(DCM_DirectoryRecordSequence, record, -2);
        record->putAndInsertString(DCM_ReferencedFileID, ("IMAGES\\" + std::to_string(n) + ".dcm").c_str());
    }
    dataset.putAndInsertString(DCM_SOPClassUID, UID_MediaStorageDirectoryStorage);
    dataset.putAndInsertString(DCM_SOPInstanceUID, "1.2.3.4");
    ASSERT_TRUE(format.saveFile((folder / "disc/DICOMDIR").c_str(), EXS_LittleEndianExplicit).good());
    const auto report = import({folder / "disc/DICOMDIR"});
    EXPECT_EQ(report.scans_stored, 1) << lines(report);
    EXPECT_EQ(report.refused, 4) << lines(report);
    EXPECT_TRUE(says(report, Kind::refused, "names a file that is not there: IMAGES/gone.dcm"));
    EXPECT_TRUE(says(report, Kind::refused, "names a file that is not there: LLL"));
    // The folder that holds it brings everything, and says nothing of the directory file.
    const auto whole = import({folder / "disc"});
    EXPECT_EQ(whole.refused, 0) << lines(whole);
    EXPECT_EQ(store.scans(CaseStore::caseIdFor(SeriesSpec{}.study_uid)).size(), 2u);
}

/// DCMTK's parser would throw there, on its way through any file that holds such a record.
TEST_F(Archive, ARecordOfATypeTooLongIsOneLine)
{
    const auto files = writeSeries(folder / "disc/IMAGES", {});
    const auto addRecord = [](DcmFileFormat& format) {
        DcmItem* record = nullptr;
        format.getDataset()->findOrCreateSequenceItem(DCM_DirectoryRecordSequence, record, -2);
        record->putAndInsertString(DCM_DirectoryRecordType, "AAAAAAAAAAAAAAAAAAAA\\BBBBBBBBBBBBBBBBBBBB");
    };
    DcmFileFormat directory, slice;
    addRecord(directory);
    directory.getDataset()->putAndInsertString(DCM_SOPClassUID, UID_MediaStorageDirectoryStorage);
    directory.getDataset()->putAndInsertString(DCM_SOPInstanceUID, "1.2.3.4");
    ASSERT_TRUE(directory.saveFile((folder / "disc/DICOMDIR").c_str(), EXS_LittleEndianExplicit).good());
    ASSERT_TRUE(slice.loadFile(files[0].c_str()).good());
    ASSERT_TRUE(slice.loadAllDataIntoMemory().good());
    addRecord(slice);
    ASSERT_TRUE(slice.saveFile(files[0].c_str(), EXS_LittleEndianExplicit).good());
    const auto by_directory = import({folder / "disc/DICOMDIR", files[1]});
    EXPECT_TRUE(says(by_directory, Kind::refused, "(0004,1430) has 42 bytes")) << lines(by_directory);
    EXPECT_EQ(by_directory.refused, 1) << lines(by_directory);
    const auto by_folder = import({folder / "disc"});
    EXPECT_EQ(by_folder.refused, 1) << lines(by_folder);
    EXPECT_TRUE(says(by_folder, Kind::refused, "truncated or damaged")) << lines(by_folder);
}

}  // namespace
