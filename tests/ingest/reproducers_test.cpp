// Each file that once broke something has its line within the limits, and the rest of the import is done.
#include <gtest/gtest.h>

#include "import_fixture.h"
#include "measured_cost.h"

namespace fs = std::filesystem;
using namespace vicon;
using namespace vicon::test;
using Kind = ingest::ImportLine::Kind;

namespace {

struct HostileCase {
    const char* path;
    Kind kind;
    const char* words;
    const char* series = nullptr;  ///< how the UID of the line's subject begins; none: the subject is the file
};

/// Of the series that are whole folders, of the single images, and one that stands for no UID.
constexpr const char *kGenerated = "1.2.826.0.1.3680043.9.9999.", *kSeed = "1.2.840.777.22222222", *kStandIn = "2.25.";

void PrintTo(const HostileCase& c, std::ostream* out)
{
    *out << c.path;
}

const HostileCase kCases[] = {
    {"01-j2k-heap-overflow/j2k_128x128.dcm", Kind::refused, "stream holds 24 x 32 pixels, its header says 128 x 128"},
    {"01-j2k-heap-overflow/j2k_16x24.dcm", Kind::refused, "stream holds 24 x 32 pixels, its header says 24 x 16"},
    {"01-j2k-heap-overflow/j2k_alloc8.dcm", Kind::refused, "samples of 16 bits, its header allocates 8"},
    {"01-j2k-heap-overflow/series_crashes_work", Kind::refused, "its compressed stream holds 24 x 32 pixels", kSeed},
    {"02-one-bit-flip-hang-memory/001", Kind::refused, "its meta header breaks off at (0002,0002)"},
    {"02-one-bit-flip-hang-memory/flip_meta_sopclass.dcm", Kind::refused, "its meta header breaks off"},
    {"03-nested-sequences-segv/nest_d6000.dcm", Kind::refused, "nested deeper than 64"},
    {"03-nested-sequences-segv/nest_u10000.dcm", Kind::refused, "nested deeper than 64"},
    {"04-non-utf8-aborts-import/u_kernel_legal", Kind::stored, "12 slices", kGenerated},
    {"05-dims-mismatch-silent/j2k_128x128.dcm", Kind::refused, "its header says 128 x 128"},
    {"05-dims-mismatch-silent/jll_128x128.dcm", Kind::refused, "its header says 128 x 128"},
    {"05-dims-mismatch-silent/jls_16x24.dcm", Kind::refused, "its header says 24 x 16"},
    {"05-dims-mismatch-silent/rle_48x16.dcm", Kind::refused, "runs that cross its rows"},
    {"08-decimal-comma/comma_slope", Kind::repaired, "decimal commas read as points", kGenerated},
    {"08-decimal-comma/comma_spacing", Kind::repaired, "decimal commas read as points", kGenerated},
    {"08-decimal-comma/comma_position", Kind::repaired, "decimal commas read as points", kGenerated},
    {"09-terminal/t_newline", Kind::stored, "12 slices", kGenerated},
    {"09-terminal/t_nul", Kind::stored, "12 slices", kGenerated},
    {"09-terminal/t_type_esc", Kind::refused, "no CT densities (Rescale Type HU\\x1b[2J\\nfake line)", kGenerated},
    {"09-terminal/t_uid_esc", Kind::repaired, "is no UID: another stands for 1.2.3\\x1b[31m4", kStandIn},
    {"09-terminal/u_esc_utf8", Kind::stored, "12 slices", kGenerated},
    {"11-mixed-series/g_interleaved_acq", Kind::repaired,
     "one series holds 2 acquisitions; this one: acquisition number 2", kGenerated},
    {"11-mixed-series/g_interleaved_kernel", Kind::repaired, "one series holds 2 acquisitions; this one: kernel B",
     kGenerated},
    {"11-mixed-series/g_supine_then_prone_in_one_series", Kind::repaired,
     "one series holds 2 acquisitions; this one: patient position HFP", kGenerated},
    {"12-overflowing-positions/g_outlier1e200", Kind::refused, "more than 10 m"},
    {"12-overflowing-positions/g_outlier3e9", Kind::refused, "more than 10 m"},
    {"12-overflowing-positions/g_pix1e-9", Kind::refused, "a size that no scanner has", kGenerated},
    {"13-silence/DICOMDIR", Kind::refused, "names a file that is not there: S21610/DIRFILE"},
    {"14-header-pixels-disagree/len_alloc8", Kind::refused, "more pixels than its header says", kGenerated},
    {"14-header-pixels-disagree/len_columns_short", Kind::refused, "more pixels than its header says", kGenerated},
    {"15-trailing-bytes-un/UN_intercept", Kind::kept, "1 slice", kSeed},
    {"15-trailing-bytes-un/UN_ipp", Kind::kept, "1 slice", kSeed},
    {"15-trailing-bytes-un/UN_rows", Kind::kept, "1 slice", kSeed},
    {"15-trailing-bytes-un/UN_undef_priv", Kind::kept, "1 slice", kSeed},
    {"15-trailing-bytes-un/trail_1zero", Kind::repaired, "behind the end of its data", kSeed},
    {"15-trailing-bytes-un/trail_2zero", Kind::repaired, "behind the end of its data", kSeed},
    {"15-trailing-bytes-un/trail_8zero", Kind::repaired, "behind the end of its data", kSeed},
    {"15-trailing-bytes-un/trail_512zero", Kind::repaired, "behind the end of its data", kSeed},
    {"15-trailing-bytes-un/trail_ff", Kind::repaired, "behind the end of its data", kSeed},
    {"15-trailing-bytes-un/trail_jpeg_8zero", Kind::repaired, "behind the end of its data", kSeed},
    {"15-trailing-bytes-un/trail_newline", Kind::repaired, "behind the end of its data", kSeed},
    {"15-trailing-bytes-un/trail_text", Kind::repaired, "behind the end of its data", kSeed},
    {"15-trailing-bytes-un/trail_padding_element", Kind::kept, "1 slice", kSeed},
};

/// Whether a line tells of the reproducer, and not of the good series beside it.
bool isAbout(const ingest::ImportLine& line, const HostileCase& c)
{
    if (c.series)
        return line.subject.starts_with(c.series);
    return line.subject.find(c.path) != std::string::npos;
}

class EachReproducer : public Import, public testing::WithParamInterface<HostileCase> {};

TEST_P(EachReproducer, HasItsLineAndTheRestOfTheImportIsDone)
{
    VICON_NEEDS_DATA("hostile");
    const HostileCase& c = GetParam();
    SeriesSpec good;
    good.patient_id = "good";
    good.slices = 17;  // as no reproducer has
    writeSeries(folder / "z-good", good);
    ingest::ImportReport report;
    expectBearable([&] { report = import({support::sharedData("hostile") / c.path, folder / "z-good"}); }, c.path);
    EXPECT_TRUE(std::any_of(report.lines.begin(), report.lines.end(), [&](const auto& line) {
        return isAbout(line, c) && line.kind == c.kind && line.text.find(c.words) != std::string::npos;
    })) << lines(report);
    EXPECT_TRUE(says(report, Kind::stored, "17 slices")) << lines(report);
    for (const auto& line : report.lines)
        EXPECT_NO_THROW((void)nlohmann::json(line.subject + line.text).dump()) << c.path;
    for (const CaseRecord& a_case : store.cases())
        for (const ScanRecord& scan : store.scans(a_case.id)) {
            if (scan.role == ScanRole::refused)
                continue;
            EXPECT_NO_THROW(load(scan)) << c.path;
        }
}

INSTANTIATE_TEST_SUITE_P(OfTheData, EachReproducer, testing::ValuesIn(kCases));

}  // namespace
