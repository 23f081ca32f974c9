#pragma once

#include <optional>
#include <vector>

#include "vicon/viewer/model/unseen.h"

namespace vicon::viewer {

/// The missed regions as the reader works through them: in order from the rectum, each with what was reviewed of it
/// since.
class MissedRegions {
public:
    MissedRegions() = default;
    /// @param patches in any order
    explicit MissedRegions(std::vector<UnseenPatch> patches);

    const std::vector<UnseenPatch>& regions() const { return regions_; }
    /// Reviewed, but for its edge, which is seen at a slant from everywhere.
    bool done(std::size_t region) const { return done_[region]; }
    std::size_t countDone() const;
    /// True where one was ticked off. What was done stays so.
    bool tick(const Coverage& coverage);
    /// The next one that is not done: after the one visited last, past the last one from the first; nothing: none.
    std::optional<std::size_t> next() const;
    void visit(std::size_t region) { visited_ = region; }
    std::optional<std::size_t> visited() const { return visited_; }
    /// Of each triangle: 1 where it is of the region; else 0.
    std::vector<std::uint8_t> trianglesOf(std::size_t region, std::size_t triangle_count) const;

private:
    std::vector<UnseenPatch> regions_;
    std::vector<bool> done_;
    std::optional<std::size_t> visited_;
};

}  // namespace vicon::viewer
