#pragma once

#include <string>

#include "command.h"
#include "vicon/phantom/phantom.h"

namespace vicon::app {

/// The synthetic case that is read without a patient's: it is made, imported and prepared in the context's store where
/// it is not there yet, which takes a minute or two and is shown. What was stopped goes on the next time.
/// @param study what is synthesised
/// @return the case's id
/// Throws Error{not_ready} where it was stopped or could not be prepared, Error{store}.
std::string demoCase(Context& context, const phantom::PhantomOptions& study = {});

}  // namespace vicon::app
