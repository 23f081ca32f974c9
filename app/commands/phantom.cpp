#include "vicon/phantom/phantom.h"

#include <cstdio>

#include "../command.h"
#include "../progress_line.h"
#include "vicon/core/error.h"
#include "vicon/phantom/organ_phantom.h"

namespace vicon::app {
namespace {

struct PhantomArguments {
    std::string out, size;
    phantom::PhantomOrgan organ = phantom::PhantomOrgan::colon;
    bool supine = false, prone = false;
    phantom::PhantomOptions options;
};

std::array<int, 3> sizeFrom(const std::string& text)
{
    std::array<int, 3> size{};
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%dx%d%c", &size[0], &size[1], &size[2], &rest) != 3 || size[0] < 16 ||
        size[1] < 16 || size[2] < 8 || size[0] > 2048 || size[1] > 2048 || size[2] > 4096)
        throw Error(ErrorCode::wrong_use, "'" + text + "' is not a size", "--size",
                    "write COLUMNSxROWSxSLICES, as in 512x512x430");
    return size;
}

int makePhantom(const PhantomArguments& arguments)
{
    phantom::PhantomOptions options = arguments.options;
    if (!arguments.size.empty())
        options.size = sizeFrom(arguments.size);
    if (arguments.supine != arguments.prone) {  // naming one position means that one alone
        options.supine = arguments.supine;
        options.prone = arguments.prone;
    }
    ProgressLine progress("phantom");
    if (arguments.organ == phantom::PhantomOrgan::colon) {
        phantom::writeStudy(arguments.out, options, progress);
    } else {
        phantom::OrganPhantomOptions other{.organ = arguments.organ, .seed = options.seed};
        if (!arguments.size.empty())
            other.size = options.size;
        phantom::writeOrganStudy(arguments.out, other, progress);
    }
    progress.clear();
    std::printf("%s\n", arguments.out.c_str());
    return 0;
}

/// What scanner and protocol make of the same patient.
void addScannerOptions(CommandLine& command, phantom::PhantomOptions& options)
{
    phantom::Protocol& protocol = options.protocol;
    command.option("--noise", options.noise_hu, "Noise in HU (default: drawn from 15 to 40)").check(range(0.0, 500.0));
    command.option("--kernel", protocol.kernel, "Point spread; with a sharp one edges overshoot").captureDefault();
    command.option("--slice", protocol.thickness_mm, "Thickness of the slices in mm (default: 1)")
        .check(range(0.5, 5.0));
    command.option("--tagging", protocol.tagging_hu, "Density of the pools in HU (default: drawn from 300 to 900)")
        .check(range(100.0, 2000.0));
    command.option("--bubbles", protocol.bubbles, "Bubbles in the pools; without a number: 40")
        .valueIfBare("40")
        .check(range(0, 200));
    command.flag("--contrast", protocol.contrast, "Contrast medium in wall, vessels and organs");
    command.option("--hips", protocol.hips, "Streaks from hip to hip, or the right one of metal").captureDefault();
}

}  // namespace

Subcommand phantomCommand()
{
    return {
        "phantom", "Write a synthetic CT colonography study in DICOM, with its ground truth", [](CommandLine& command) {
            auto arguments = std::make_shared<PhantomArguments>();
            phantom::PhantomOptions& options = arguments->options;
            command.option("OUT", arguments->out, "Folder to write to; made, and must be empty").required();
            command.option("--organ", arguments->organ, "Which organ; those but the colon take --seed and --size alone")
                .captureDefault();
            command.flag("--supine", arguments->supine, "Make the supine scan (default: supine and prone)");
            command.flag("--prone", arguments->prone, "Make the prone scan");
            command.option("--decubitus", options.decubitus, "One scan more, lying on this side");
            command.flag("--stretch", options.stretch,
                         "The wall is drawn out, turned and distended otherwise in every position");
            command.flag("--feet-first", options.feet_first, "The patient enters the scanner feet first");
            command.option("--oblique", options.oblique_deg, "Turn the slices by so many degrees")
                .check(range(-30.0, 30.0));
            command.flag("--fluid,!--no-fluid", options.fluid, "Pools of tagged fluid (default: yes)");
            command.option("--gap", options.gaps, "Collapsed segments in each scan; without a number: 1")
                .valueIfBare("1")
                .check(range(0, 4));
            command.option("--polyps", options.polyps, "Polyps of 5 to 10 mm").check(range(0, 12)).captureDefault();
            command.flag("--folds,!--no-folds", options.folds, "Haustra and folds (default: yes)");
            command.flag("--catheter,!--no-catheter", options.catheter, "A rectal tube (default: yes)");
            command.flag("--thin-walls", options.thin_walls, "Loops with 1 mm of wall between them");
            command.flag("--self-contact", options.self_contact, "Two loops run into one another once");
            command
                .option("--stool", options.stool, "Lumps of tagged stool, half of them with air; without a number: 12")
                .valueIfBare("12")
                .check(range(0, 40));
            command.flag("--film", options.film, "Films of tagging on the polyps");
            command.flag("--ileum", options.ileum, "A terminal ileum filled through the ileocaecal valve");
            command.option("--mr", options.mr, "MR images in place of CT, the lumen dark or bright in them");
            command.flag("--low-dose", options.low_dose, "Noise of 50 to 80 HU");
            addScannerOptions(command, options);
            command.option("--seed", options.seed, "Number that the study is drawn from").captureDefault();
            command.option("--size", arguments->size, "Voxels (default: 512x512x430)").typeName("COLUMNSxROWSxSLICES");
            return [arguments](Context&) { return makePhantom(*arguments); };
        }};
}

}  // namespace vicon::app
