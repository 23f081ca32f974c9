#pragma once

#include <string>
#include <vector>

#include "stack_plan.h"

namespace vicon::ingest {

/// How sharp a reconstruction kernel is, from the makers' names.
enum class Sharpness { soft, unknown, sharp };
Sharpness sharpnessOf(const std::string& kernel);

/// A stack that has enough slices and makes a volume, with its plan.
struct Reconstruction {
    const Stack* stack = nullptr;
    const StackPlan* plan = nullptr;
};

/// For each reconstruction of a study, the index of the one that stands for its acquisition: its own index for those
/// that become scans. That is the thinnest soft one; reformats and those that cover clearly less come last.
std::vector<std::size_t> chooseScans(const std::vector<Reconstruction>& reconstructions);

}  // namespace vicon::ingest
