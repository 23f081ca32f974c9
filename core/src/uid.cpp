#include "vicon/core/uid.h"

#include <algorithm>
#include <random>

#include "vicon/core/file.h"

namespace vicon {
namespace {

/// A UUID, given as 32 hexadecimal digits, in decimal digits, as PS3.5 B.2 writes them. Its version is marked in it.
std::string uidFromUuid(std::string hex, char version)
{
    hex[12] = version;
    hex[16] = "89ab"[std::stoi(hex.substr(16, 1), nullptr, 16) % 4];
    __uint128_t value = 0;
    for (const char digit : hex)
        value = value * 16 + unsigned(std::stoi(std::string(1, digit), nullptr, 16));
    std::string decimal;
    for (; value > 0; value /= 10)
        decimal += char('0' + int(value % 10));
    std::reverse(decimal.begin(), decimal.end());
    return "2.25." + decimal;
}

}  // namespace

std::string uidFor(std::string_view text)
{
    return uidFromUuid(sha256(text).substr(0, 32), '8');  // made by the application
}

std::string randomUid()
{
    std::random_device device;
    std::string hex;
    for (int n = 0; n < 32; ++n)
        hex += "0123456789abcdef"[device() % 16];
    return uidFromUuid(hex, '4');
}

}  // namespace vicon
