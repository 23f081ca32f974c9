#include "mask/labelled_slices.h"

#include <algorithm>

namespace vicon::ingest {
namespace {

constexpr std::size_t kMostLabels = 250;  // a byte a voxel

}  // namespace

/// 0 where there is no code left.
LabelledSlices::Code LabelledSlices::codeOf(std::int64_t label)
{
    if (label == last_label_)
        return last_code_;
    const auto known = codes_.find(label);
    if (known == codes_.end() && codes_.size() >= kMostLabels)
        return 0;
    last_code_ = known == codes_.end() ? (codes_[label] = Code(codes_.size() + 1)) : known->second;
    last_label_ = label;
    last_count_ = &counts_[label];
    return last_code_;
}

bool LabelledSlices::set(Index3 voxel, std::int64_t label)
{
    if (label == 0)
        return true;
    const Code code = codeOf(label);
    if (code == 0)
        return false;
    std::vector<Code>& slice = slices_[std::size_t(voxel.k)];
    if (slice.empty())
        slice.resize(std::size_t(grid_.size[0]) * std::size_t(grid_.size[1]));
    slice[std::size_t(voxel.i) + std::size_t(grid_.size[0]) * std::size_t(voxel.j)] = code;
    ++*last_count_;
    return true;
}

InsideVolume LabelledSlices::only(std::int64_t label) const
{
    const Code code = codes_.at(label);
    Index3 low{grid_.size[0], grid_.size[1], grid_.size[2]}, high{-1, -1, -1};
    const auto forEach = [&](auto use) {
        for (int k = 0; k < grid_.size[2]; ++k)
            for (std::size_t n = 0; n < slices_[std::size_t(k)].size(); ++n)
                if (slices_[std::size_t(k)][n] == code)
                    use(Index3{int(n % std::size_t(grid_.size[0])), int(n / std::size_t(grid_.size[0])), k});
    };
    forEach([&](Index3 v) {
        low = {std::min(low.i, v.i), std::min(low.j, v.j), std::min(low.k, v.k)};
        high = {std::max(high.i, v.i), std::max(high.j, v.j), std::max(high.k, v.k)};
    });
    low = {std::max(low.i - 1, 0), std::max(low.j - 1, 0), std::max(low.k - 1, 0)};
    high = {std::min(high.i + 1, grid_.size[0] - 1), std::min(high.j + 1, grid_.size[1] - 1),
            std::min(high.k + 1, grid_.size[2] - 1)};
    Grid part = grid_;
    part.origin_mm = grid_.pointAt(low);
    part.size = {high.i - low.i + 1, high.j - low.j + 1, high.k - low.k + 1};
    InsideVolume mask(part);
    forEach([&](Index3 v) { mask.at({v.i - low.i, v.j - low.j, v.k - low.k}) = 1; });
    return mask;
}

Point3 LabelledSlices::middle_mm() const
{
    const auto& [nx, ny, nz] = grid_.size;
    return grid_.pointAt(ContinuousIndex3{(nx - 1) / 2.0, (ny - 1) / 2.0, (nz - 1) / 2.0});
}

}  // namespace vicon::ingest
