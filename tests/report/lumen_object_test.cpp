// The segmentation of a lumen says who made it.
#include <gmock/gmock.h>

#include "dicom_writer.h"
#include "store_fixture.h"
#include "vicon/cases/step_results.h"
#include "vicon/report/report_objects.h"
#include "vicon/scan_files/skeleton_file.h"
#include "vicon/scan_files/volume_file.h"

namespace vicon::test {

namespace fs = std::filesystem;

namespace {

using testing::HasSubstr;
using testing::Not;

const LumenOrigin kOther{
    .form = "NIfTI", .sha256 = std::string(64, 'a'), .label = 7, .by = "jörg", .at = "2026-11-25T12:00:00Z"};

/// A scan all of whose voxels are lumen.
class LumenObject : public StoreFixture {
protected:
    std::string case_id_;

    void SetUp() override
    {
        import(writeSeries(folder / "in", {}));
        const ScanRecord scan = onlyScan();
        case_id_ = scan.case_id;
        const fs::path at = store.scanFolder(scan.case_id, scan.id);
        scan_files::writeVolume(at / "inside.mha", InsideVolume(load(scan).grid, kGas), scan_files::Packing::zlib);
        Skeleton straight;
        straight.pieces = {{false, {{{0, 0, 0}, 0, 5}, {{0, 0, 10}, 10, 5}}}};
        scan_files::writeSkeleton(at / "skeleton.vtp", straight);
    }
    void segment(const std::optional<LumenOrigin>& given)
    {
        SegmentFound found{
            .verdict = Verdict::found, .organ_title = "colon", .reason = {}, .organ = {}, .given = given};
        const std::string result = toJson(found).dump(), scan = onlyScan().id;
        store.database().write([&](soci::session& sql) {
            sql << "INSERT INTO steps (case_id, scan_id, step, version, digest, parameters, result, seconds, finished)"
                   " VALUES (:case, :scan, 'segment', 1, 'd', '{}', :result, 1, '')",
                soci::use(case_id_), soci::use(scan), soci::use(result);
        });
    }
    /// What is in the object, by another program; it has no fault.
    std::string dumped(report::ObjectKind kind = report::ObjectKind::lumen, const char* by = "dcmdump +L ")
    {
        const ReadCase read = readCase(store, case_id_);
        const ReportVersion version{.version = 1,
                                    .state = ReportState::final,
                                    .person = "reader",
                                    .at = "2026-11-23T20:15:30Z",
                                    .software = "0.1.0",
                                    .digest = "d"};
        report::ShownScans scans(store, read);
        const auto objects =
            report::writeReportObjects(scans, {read, version, std::nullopt, "pdf", {}, {kind}}, folder.path());
        if (objects.size() != 1)
            return std::to_string(objects.size()) + " objects";
        const std::string plain = (folder / "plain.dcm").string();
        support::runCommand("dcmconv +te " + objects[0].file.string() + " " + plain);
        EXPECT_THAT(support::runCommand("dciodvfy " + plain).output, Not(HasSubstr("Error")));
        return support::runCommand(by + plain).output;
    }
};

TEST_F(LumenObject, SaysThatViconSegmentedWhatItFound)
{
    segment(std::nullopt);
    EXPECT_THAT(dumped(), testing::AllOf(HasSubstr("[segmented by VICON]"), HasSubstr("SegmentAlgorithmName"),
                                         HasSubstr("gas and tagged fluid"), Not(HasSubstr("another program"))));
}

TEST_F(LumenObject, NamesAnotherProgramsLumenAsThatAndNotAsViconsOwn)
{
    segment(kOther);
    EXPECT_THAT(dumped(),
                testing::AllOf(HasSubstr("[Lumen of the colon, made by another program]"),
                               HasSubstr("[Another program's, not known to VICON]"),
                               HasSubstr("[Made by another program: NIfTI, label 7, SHA-256 aaaaaaaaaaaa..., "
                                         "given by jörg on 2026-11-25T12:00:00Z]"),
                               HasSubstr("segmented by another program"), Not(HasSubstr("segmented by VICON"))));
}

TEST_F(LumenObject, OfAnotherProgramIsNamedInTheMeasurementsThatRestOnIt)
{
    segment(kOther);
    const std::string tree = dumped(report::ObjectKind::measurements, "dsrdump +Pl ");
    EXPECT_THAT(
        tree, testing::AllOf(HasSubstr("Lumen made by another program"), HasSubstr("Algorithm Name"),
                             HasSubstr("Another program's, not known to VICON"),
                             HasSubstr("Made by another program: NIfTI, label 7, SHA-256 aaaaaaaaaaaa..., given by")));
}

TEST_F(LumenObject, ThatViconFoundIsNotMentionedInTheMeasurements)
{
    segment(std::nullopt);
    EXPECT_THAT(dumped(report::ObjectKind::measurements, "dsrdump +Pl "), Not(HasSubstr("another program")));
}

}  // namespace
}  // namespace vicon::test
