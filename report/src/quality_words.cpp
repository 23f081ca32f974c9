#include "quality_words.h"

#include <array>
#include <cstdio>

namespace vicon::report {

std::string qualityWords(const ScanQuality& quality)
{
    std::string out = quality.whole.adequate ? "adequate" : "not adequate";
    if (!quality.reason.empty())
        out += ": " + quality.reason;
    if (quality.noise_hu <= 0)  // not told: MR, or no place is even enough
        return out;
    std::array<char, 48> noise{};
    std::snprintf(noise.data(), noise.size(), "\nnoise %.0f HU", quality.noise_hu);
    return out + noise.data();
}

}  // namespace vicon::report
