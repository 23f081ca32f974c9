#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>

namespace vicon::phantom {

/// Scrambles 64 bits (the finaliser of SplitMix64, Steele et al. 2014).
inline std::uint64_t mix(std::uint64_t z)
{
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
}

/// Nearly normal, mean 0, deviation 1: the sum of four uniform numbers.
inline float whiteNoise(std::uint64_t seed, std::uint64_t voxel)
{
    const std::uint64_t bits = mix(seed + voxel * 0x9e3779b97f4a7c15ULL);
    const auto part = [bits](int shift) { return int((bits >> shift) & 0xffff); };
    constexpr float kScale = 1.0F / 37837.2F;  // 65536 / sqrt(3)
    return float(part(0) + part(16) + part(32) + part(48) - 2 * 65535) * kScale;
}

/// A stream of random numbers that is the same on every platform: the standard's distributions are not.
/// Each purpose draws from a stream of its own, so a new purpose changes no other.
class Random {
public:
    Random(std::uint64_t seed, std::string_view purpose, std::uint64_t number = 0)
        : state_(mix(seed + 0x9e3779b97f4a7c15ULL * (number + 1)))
    {
        for (const char c : purpose)
            state_ = mix(state_ ^ std::uint64_t(static_cast<unsigned char>(c)) ^ 0x632be59bd9b4e019ULL);
    }
    std::uint64_t bits() { return mix(state_ += 0x9e3779b97f4a7c15ULL); }
    double uniform() { return double(bits() >> 11) * 0x1p-53; }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    /// A whole number from 0 to n-1.
    int below(int n) { return int(uniform() * n); }
    double normal()
    {
        const double u = 1 - uniform();
        return std::sqrt(-2 * std::log(u)) * std::cos(2 * 3.14159265358979323846 * uniform());
    }

private:
    std::uint64_t state_;
};

}  // namespace vicon::phantom
