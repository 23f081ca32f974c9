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
    void visit(std::size_t region);
    std::optional<std::size_t> visited() const { return visited_; }
    /// What is missed of the same wall by now, none of it visited. A region that shares wall with one that was looked
    /// at counts as looked at.
    MissedRegions listedAnew(std::vector<UnseenPatch> patches) const;
    /// Regions of this list, and of those before it, that were visited.
    std::size_t countLookedAt() const;
    /// Those of this list, and those before it that were looked at and are missed no longer.
    std::size_t countListed() const { return regions_.size() + looked_at_before_.size(); }
    /// Of each triangle: 1 where it is of the region; else 0.
    std::vector<std::uint8_t> trianglesOf(std::size_t region, std::size_t triangle_count) const;

private:
    std::vector<UnseenPatch> regions_;
    std::vector<bool> done_, looked_at_;
    std::vector<UnseenPatch> looked_at_before_;  // and in this list no longer
    std::optional<std::size_t> visited_;
};

}  // namespace vicon::viewer
