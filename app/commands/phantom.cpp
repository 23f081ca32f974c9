#include "vicon/phantom/phantom.h"

#include <cstdio>

#include "../command.h"
#include "../progress_line.h"
#include "vicon/core/error.h"
#include "vicon/phantom/organ_phantom.h"

namespace vicon::app {
namespace {

struct PhantomArguments {
    std::string out, size, organ = "colon";
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
    if (arguments.organ == "colon") {
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

}  // namespace

Subcommand phantomCommand()
{
    return {
        "phantom", "Write a synthetic CT colonography study in DICOM, with its ground truth", [](CLI::App& command) {
            auto arguments = std::make_shared<PhantomArguments>();
            phantom::PhantomOptions& options = arguments->options;
            command.add_option("OUT", arguments->out, "Folder to write to; made, and must be empty")->required();
            command
                .add_option("--organ", arguments->organ,
                            "Which organ; an airway and an aorta take --seed and --size alone")
                ->check(CLI::IsMember({"colon", "airway", "aorta"}))
                ->capture_default_str();
            command.add_flag("--supine", arguments->supine, "Make the supine scan (default: supine and prone)");
            command.add_flag("--prone", arguments->prone, "Make the prone scan");
            command.add_option("--decubitus", options.decubitus, "One scan more, lying on this side")
                ->check(CLI::IsMember({"none", "left", "right"}));
            command.add_flag("--feet-first", options.feet_first, "The patient enters the scanner feet first");
            command.add_option("--oblique", options.oblique_deg, "Turn the slices by so many degrees")
                ->check(CLI::Range(-30, 30));
            command.add_flag("--fluid,!--no-fluid", options.fluid, "Pools of tagged fluid (default: yes)");
            command.add_option("--gap", options.gaps, "Collapsed parts in each scan; without a number: 1")
                ->expected(0, 1)
                ->default_str("1")
                ->check(CLI::Range(0, 4));
            command.add_option("--polyps", options.polyps, "Polyps of 5 to 10 mm")
                ->check(CLI::Range(0, 12))
                ->capture_default_str();
            command.add_flag("--folds,!--no-folds", options.folds, "Haustra and folds (default: yes)");
            command.add_flag("--catheter,!--no-catheter", options.catheter, "A rectal tube (default: yes)");
            command.add_flag("--thin-walls", options.thin_walls, "Loops with 1 mm of wall between them");
            command.add_flag("--self-contact", options.self_contact, "Two loops run into one another once");
            command.add_flag("--ileum", options.ileum, "A terminal ileum filled through the ileocaecal valve");
            command.add_flag("--low-dose", options.low_dose, "Noise of 50 to 80 HU");
            command.add_option("--seed", options.seed, "Number that the study is drawn from")->capture_default_str();
            command.add_option("--size", arguments->size, "Voxels (default: 512x512x430)")
                ->type_name("COLUMNSxROWSxSLICES");
            return [arguments](Context&) { return makePhantom(*arguments); };
        }};
}

}  // namespace vicon::app
