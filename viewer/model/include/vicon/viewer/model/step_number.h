#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

namespace vicon::viewer {

/// Orders what a reader did over several histories: what was done later has the larger number.
using StepNumber = std::uint64_t;

inline StepNumber nextStep()
{
    static std::atomic<StepNumber> last = 0;
    return ++last;
}

/// Of two histories: whether the first has the step that is to be taken back next. Nothing: there is none in it.
inline bool undoneBefore(std::optional<StepNumber> first, std::optional<StepNumber> second)
{
    return first && (!second || *first > *second);
}

/// Of two histories: whether the first has the step that is to be done again next.
inline bool redoneBefore(std::optional<StepNumber> first, std::optional<StepNumber> second)
{
    return first && (!second || *first < *second);
}

}  // namespace vicon::viewer
