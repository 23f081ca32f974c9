#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vicon/core/colon_parts.h"
#include "vicon/core/option_names.h"
#include "vicon/core/options.h"
#include "vicon/core/progress.h"
#include "vicon/core/skeleton.h"
#include "vicon/core/volume.h"

namespace vicon::phantom {

/// The reconstruction's point spread: sigma of 0.8 to 1.1 mm, 0.5 to 0.8, or 0.45 to 0.6 with edges that overshoot.
enum class Kernel { smooth, usual, sharp };
inline constexpr EnumNames<Kernel, 3> kKernelNames{
    {{Kernel::smooth, "smooth"}, {Kernel::usual, "usual"}, {Kernel::sharp, "sharp"}}};
constexpr const auto& optionNames(Kernel /*value*/)
{
    return kKernelNames;
}

/// What the hips do to the slices through them. streaks: too few photons pass both; metal: the right one replaced too.
enum class Hips { quiet, streaks, metal };
inline constexpr EnumNames<Hips, 3> kHipsNames{
    {{Hips::quiet, "quiet"}, {Hips::streaks, "streaks"}, {Hips::metal, "metal"}}};
constexpr const auto& optionNames(Hips /*value*/)
{
    return kHipsNames;
}

/// On which side the patient lies in a scan beside supine and prone.
enum class Decubitus { none, left, right };
inline constexpr EnumNames<Decubitus, 3> kDecubitusNames{
    {{Decubitus::none, "none"}, {Decubitus::left, "left"}, {Decubitus::right, "right"}}};
constexpr const auto& optionNames(Decubitus /*value*/)
{
    return kDecubitusNames;
}

/// none: CT; else MR colonography with such a lumen, all of it filled alike.
enum class MrLumen { none, dark, bright };
inline constexpr EnumNames<MrLumen, 3> kMrLumenNames{
    {{MrLumen::none, "none"}, {MrLumen::dark, "dark"}, {MrLumen::bright, "bright"}}};
constexpr const auto& optionNames(MrLumen /*value*/)
{
    return kMrLumenNames;
}

/// What scanner and protocol make of the same patient.
struct Protocol {
    Kernel kernel = Kernel::usual;
    double thickness_mm = 0;  ///< of the slices, side by side; 0: thin ones of slice_spacing_mm
    double tagging_hu = 0;    ///< of every pool; 0: drawn from 300 to 900
    int bubbles = 0;          ///< of gas in the pools, 2 to 6 mm, right below their levels
    bool contrast = false;    ///< medium in the veins: wall of 120 HU, vessels of 160, organs too
    Hips hips = Hips::quiet;
};

/// What to synthesise. The same options give the same study, bit for bit, on any number of threads.
struct PhantomOptions {
    std::uint64_t seed = 1;
    std::array<int, 3> size{512, 512, 430};     ///< columns, rows, slices
    std::array<double, 3> spacing_mm{0, 0, 0};  ///< 0: as it takes to cover 379 x 379 x 430 mm, where the patient fits
    bool supine = true;
    bool prone = true;
    Decubitus decubitus = Decubitus::none;  ///< one scan more, lying on that side
    bool stretch = false;  ///< the wall is drawn out by 0.7 to 1.4 from one position to another, turned and distended
    bool feet_first = false;
    double oblique_deg = 0;     ///< the slices are turned by this about the patient's left-right axis
    bool fluid = true;          ///< tagged pools, 300 to 900 HU
    int gaps = 1;               ///< collapsed parts per scan, 10 to 40 mm long
    int polyps = 5;             ///< sessile, 5 to 10 mm
    bool folds = true;          ///< haustra and semilunar folds
    bool catheter = true;       ///< rectal tube
    bool thin_walls = false;    ///< three places where loops lie 1.5 voxels of wall apart
    bool self_contact = false;  ///< two loops that run into one another once: the lumen's Euler number is 0
    int stool = 0;              ///< lumps of tagged stool, 5 to 18 mm, half of them with air in them
    bool film = false;          ///< tagging clings to every polyp, 0.5 to 2 mm thick
    bool ileum = false;         ///< a valve of 3 to 5 mm that gas or fluid has gone through into the terminal ileum
    double noise_hu = -1;       ///< standard deviation in soft tissue; below 0: drawn from 15 to 40
    bool low_dose = false;      ///< noise drawn from 50 to 80 HU when noise_hu is below 0
    double blur_mm = 0;         ///< sigma of the point spread; 0: drawn as the kernel has it
    MrLumen mr = MrLumen::none;
    Protocol protocol;
    bool extras = true;  ///< a localizer and a dose sheet beside the scans (writeStudy)

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("phantom.seed", seed, "", "Number that the whole study is drawn from.", {0, 4e9});
        v("phantom.columns", size[0], "", "Voxels from side to side.", {16, 2048});
        v("phantom.rows", size[1], "", "Voxels from front to back.", {16, 2048});
        v("phantom.slices", size[2], "", "Axial slices.", {8, 4096});
        v("phantom.column_spacing_mm", spacing_mm[0], "mm", "Pixel spacing along a row; 0: the patient fits.", {0, 20});
        v("phantom.row_spacing_mm", spacing_mm[1], "mm", "Pixel spacing along a column; 0: the patient fits.", {0, 20});
        v("phantom.slice_spacing_mm", spacing_mm[2], "mm", "Slice spacing; 0: the patient fits.", {0, 20});
        v("phantom.supine", supine, "", "Make a supine scan.");
        v("phantom.prone", prone, "", "Make a prone scan.");
        v("phantom.decubitus", decubitus, "", "Make a scan lying on this side.", choicesOf(decubitus));
        v("phantom.stretch", stretch, "",
          "The wall is drawn out by 0.7 to 1.4 from one position to another, turned by up to 80 degrees and "
          "distended.");
        v("phantom.feet_first", feet_first, "", "The patient enters the scanner feet first.");
        v("phantom.oblique_deg", oblique_deg, "degrees", "Turn the slices about the left-right axis.", {-30, 30});
        v("phantom.fluid", fluid, "", "Pools of tagged fluid.");
        v("phantom.gaps", gaps, "", "Collapsed parts in each scan.", {0, 4});
        v("phantom.polyps", polyps, "", "Sessile polyps of 5 to 10 mm.", {0, 12});
        v("phantom.folds", folds, "", "Haustra and semilunar folds.");
        v("phantom.catheter", catheter, "", "A rectal tube.");
        v("phantom.thin_walls", thin_walls, "", "Loops with 1.5 voxels of wall between them, in three places.");
        v("phantom.self_contact", self_contact, "", "Two loops run into one another once.");
        v("phantom.stool", stool, "", "Lumps of tagged stool of 5 to 18 mm, half of them with air.", {0, 40});
        v("phantom.film", film, "", "Films of tagging on polyps, 0.5 to 2 mm thick.");
        v("phantom.ileum", ileum, "", "A terminal ileum that is filled through the ileocaecal valve.");
        v("phantom.noise_hu", noise_hu, "HU", "Noise; below 0: drawn from 15 to 40 HU.", {-1, 500});
        v("phantom.low_dose", low_dose, "", "Noise drawn from 50 to 80 HU.");
        v("phantom.blur_mm", blur_mm, "mm", "Sigma of the point spread; 0: drawn as the kernel has it.", {0, 3});
        v("phantom.kernel", protocol.kernel, "", "Smooth, usual, or sharp with edges that overshoot.",
          choicesOf(protocol.kernel));
        v("phantom.thickness_mm", protocol.thickness_mm, "mm", "Thickness of the slices, side by side; 0: thin ones.",
          {0, 5});
        v("phantom.tagging_hu", protocol.tagging_hu, "HU", "Density of the pools; 0: drawn from 300 to 900 HU.",
          {0, 2000});
        v("phantom.bubbles", protocol.bubbles, "", "Bubbles of 2 to 6 mm below the levels of the pools.", {0, 200});
        v("phantom.contrast", protocol.contrast, "", "Contrast medium in wall, vessels and organs.");
        v("phantom.hips", protocol.hips, "", "What the hips do to the slices through them.", choicesOf(protocol.hips));
        v("phantom.mr", mr, "", "Make MR images in place of CT, with a lumen like this.", choicesOf(mr));
        v("phantom.extras", extras, "", "Write a localizer and a dose sheet too.");
    }
};

/// A sessile polyp: a ball of soft tissue that grows out of the wall.
struct Polyp {
    Point3 position_mm;  ///< centre of the ball
    double station_mm = 0;
    double diameter_mm = 0;
    double clock_deg = 0;  ///< angle about the curve: 0 anterior, clockwise as seen from the anal side
};

/// A collapsed part of the colon: no lumen between these stations.
struct CollapsedGap {
    double from_mm = 0;
    double to_mm = 0;
};

/// A pool of tagged fluid.
struct FluidPool {
    double from_mm = 0;  ///< stations
    double to_mm = 0;
    double level_mm = 0;  ///< height of its surface: -gravity . position
    double density_hu = 0;
};

/// A lump of tagged stool on the wall, part of the lumen: balls that run into one another.
struct StoolLump {
    Point3 position_mm;
    double station_mm = 0;
    double diameter_mm = 0;  ///< of the ball that holds all of it
    double density_hu = 0;
    bool airy = false;             ///< bubbles of 1.6 to 2.6 mm take about three tenths of it
    std::vector<Point3> knobs_mm;  ///< middles of the smaller balls
    std::uint64_t seed = 0;        ///< of its bubbles
};

/// A bubble of gas in a pool.
struct GasBubble {
    Point3 position_mm;  ///< its middle
    double diameter_mm = 0;
};

/// Tagging that clings to a polyp.
struct TaggingFilm {
    std::size_t polyp = 0;  ///< which of the truth's polyps
    double thickness_mm = 0;
    double density_hu = 0;
};

/// The end of the small bowel, filled from the colon; no part of the colon's lumen.
struct TerminalIleum {
    Point3 valve_mm;  ///< on the colon's inner surface
    double station_mm = 0;
    double neck_radius_mm = 0;
    double radius_mm = 0;        ///< of the tube behind the valve
    double length_mm = 0;        ///< 0: there is none
    bool through_fluid = false;  ///< the valve lies under fluid
};

/// What a scan shows, exactly.
struct PhantomTruth {
    std::vector<SkeletonPoint>
        curve;                       ///< axis of the lumen, every 1 mm from the rectum to the caecum, also through gaps
    std::vector<double> wall_mm;     ///< of each point of the curve: which place of the patient's wall lies there; the
                                     ///< same in all positions
    std::vector<Polyp> polyps;       ///< in order of station
    std::vector<CollapsedGap> gaps;  ///< in order of station
    std::vector<FluidPool> pools;    ///< in order of station
    std::vector<StoolLump> stool;    ///< in order of station
    std::vector<TaggingFilm> films;
    std::vector<GasBubble> bubbles;
    TerminalIleum ileum;
    ColonPartRanges parts;  ///< all eight, by where they are fixed, not by the shape of the curve
    Vector3 gravity;        ///< unit vector
    double length_mm = 0;   ///< of the curve
    double volume_ml = 0;   ///< of the lumen, gas and fluid
    double fluid_ml = 0;
    double noise_hu = 0;
    double blur_mm = 0;
    int euler_number = 1;  ///< of the lumen: its pieces less its loops; as counted where the field cuts the colon off
    InsideVolume inside;   ///< on the grid of the scan; of thick slices on thinner ones, up to 1 mm
};

struct PhantomScan {
    HuVolume hu;  ///< axes as a scanner writes them for the position; kPaddingHu outside the reconstruction circle
    PhantomTruth truth;
    std::string patient_position;  ///< DICOM's code: HFS, HFP, FFS, FFP, HFDL, HFDR, FFDL, FFDR
};

/// One scan of the patient that the seed stands for; positions share colon, folds and polyps, and differ in course,
/// distension, pools and gaps. Throws Error{wrong_use} on an unknown position or options out of range,
/// Error{cancelled}.
PhantomScan makeScan(const PhantomOptions& options, const std::string& patient_position, Progress& progress);

/// The scans that the options ask for, as makeScan's positions.
std::vector<std::string> positionsOf(const PhantomOptions& options);

/// "supine", "prone", "decubitus-left" or "decubitus-right".
std::string nameOfPosition(const std::string& patient_position);

/// The truth as JSON, keys with units; see docs/dev/phantom.md.
nlohmann::json describeTruth(const PhantomTruth& truth);

/// Writes a study into the folder `out`, which is made and must be empty: one folder of DICOM files per series, and
/// beside them per scan truth-POSITION.json and truth-POSITION-inside.mha. Throws also Error{store}.
void writeStudy(const std::filesystem::path& out, const PhantomOptions& options, Progress& progress);

}  // namespace vicon::phantom
