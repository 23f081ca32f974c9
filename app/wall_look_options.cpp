#include "wall_look_options.h"

namespace vicon::app {

void WallLookArguments::addTo(CommandLine& command)
{
    command.flag("--ambient-occlusion,!--no-ambient-occlusion", wall.ambient_occlusion,
                 "Less light between folds and at the foot of what rises from the wall (default: on)");
    command.option("--look", colors, "What the wall is coloured by: mucosa, bone (white) or depth").captureDefault();
    command.flag("--tagging", wall.tagging, "Tint the wall blue where tagging touches it");
}

viewer::WallLook WallLookArguments::look() const
{
    viewer::WallLook look = wall;
    look.colors = viewer::wallColorsFrom(colors);
    return look;
}

}  // namespace vicon::app
