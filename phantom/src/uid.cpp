#include "uid.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "random.h"

namespace vicon::phantom {

std::string uidFor(std::uint64_t seed, std::string_view what, std::uint64_t number)
{
    __extension__ using Wide = unsigned __int128;
    Random random(seed, what, number);
    Wide value = (Wide(random.bits()) << 64) | random.bits();
    std::string digits;
    do {
        digits += char('0' + int(value % 10));
        value /= 10;
    } while (value != 0);
    std::reverse(digits.begin(), digits.end());
    return "2.25." + digits;
}

std::string shuffledName(std::uint64_t seed, std::string_view what, std::uint64_t number)
{
    // Four digits that scramble the order, four that keep names apart.
    std::array<char, 16> name{};
    std::snprintf(name.data(), name.size(), "%04x%04x", unsigned(Random(seed, what, number).bits() & 0xffff),
                  unsigned(number & 0xffff));
    return name.data();
}

}  // namespace vicon::phantom
