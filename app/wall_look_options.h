#pragma once

#include <string>

#include "command_line.h"
#include "vicon/viewer/model/wall_look.h"

namespace vicon::app {

/// How the wall looks, as snapshot and fly are told.
struct WallLookArguments {
    viewer::WallLook wall;
    std::string colors = "mucosa";

    void addTo(CommandLine& command);
    /// Throws Error{wrong_use} for colours that there are not.
    viewer::WallLook look() const;
};

}  // namespace vicon::app
