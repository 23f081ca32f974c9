#pragma once

#include <cstdint>
#include <string>

namespace vicon::test::wire {

using namespace std::string_literals;

/// What stands on the wire, byte by byte (PS3.8, 9.3; PS3.7, 6.3; PS3.5, 7).
/// @{
inline std::string bigEndian(std::uint64_t value, int bytes)
{
    std::string out;
    for (int n = bytes - 1; n >= 0; --n)
        out += char(value >> (8 * n) & 0xff);
    return out;
}

inline std::string littleEndian(std::uint64_t value, int bytes)
{
    const std::string big = bigEndian(value, bytes);
    return {big.rbegin(), big.rend()};
}

inline std::string item(int kind, const std::string& content)
{
    return bigEndian(kind, 1) + "\0"s + bigEndian(content.size(), 2) + content;
}

inline std::string pdu(int kind, const std::string& content)
{
    return bigEndian(kind, 1) + "\0"s + bigEndian(content.size(), 4) + content;
}

inline std::string tag(int group, int number)
{
    return littleEndian(group, 2) + littleEndian(number, 2);
}

/// Implicit VR.
inline std::string element(int group, int number, std::string value)
{
    if (value.size() % 2 != 0)
        value += '\0';
    return tag(group, number) + littleEndian(value.size(), 4) + value;
}

/// In context 1.
inline std::string fragment(bool is_command, const std::string& content, bool is_last = true)
{
    return pdu(4, bigEndian(content.size() + 2, 4) + "\1"s + char((is_command ? 1 : 0) | (is_last ? 2 : 0)) + content);
}

/// In so many PDUs as DICOM's largest needs.
inline std::string fragments(bool is_command, const std::string& content)
{
    constexpr std::size_t kAtOnce = 100'000;
    std::string out;
    for (std::size_t from = 0; from < content.size(); from += kAtOnce)
        out += fragment(is_command, content.substr(from, kAtOnce), from + kAtOnce >= content.size());
    return out;
}

/// A whole command of these elements.
inline std::string command(const std::string& fields)
{
    return element(0, 0, littleEndian(fields.size(), 4)) + fields;
}

/// An association request for context 1.
inline std::string request(const std::string& sop_class, const std::string& syntax)
{
    const std::string context = item(0x20, "\1\0\0\0"s + item(0x30, sop_class) + item(0x40, syntax));
    const std::string user = item(0x50, item(0x51, bigEndian(131072, 4)) + item(0x52, "1.2.826.0.1.3680043.10.9.9"));
    return pdu(1, "\0\1\0\0VICON           HOSTILE         "s + std::string(32, '\0') +
                      item(0x10, "1.2.840.10008.3.1.1.1") + context + user);
}

/// Its acceptance.
inline std::string acceptance(const std::string& syntax)
{
    const std::string user = item(0x50, item(0x51, bigEndian(131072, 4)) + item(0x52, "1.2.826.0.1.3680043.10.9.9"));
    return pdu(2, "\0\1\0\0HOSTILE         VICON           "s + std::string(32, '\0') +
                      item(0x10, "1.2.840.10008.3.1.1.1") + item(0x21, "\1\0\0\0"s + item(0x40, syntax)) + user);
}

/// Sequences without a length, each within the one before, in implicit or explicit VR; none is ended.
inline std::string nested(int depth, bool explicit_vr)
{
    std::string out;
    for (int n = 0; n < depth; ++n)
        out += tag(8, 0x1140) + (explicit_vr ? "SQ\0\0"s : ""s) + "\xff\xff\xff\xff"s + tag(0xfffe, 0xe000) +
               "\xff\xff\xff\xff"s;
    return out;
}
/// @}

inline const std::string kImplicit = "1.2.840.10008.1.2", kExplicit = "1.2.840.10008.1.2.1",
                         kDeflated = "1.2.840.10008.1.2.1.99", kCommitment = "1.2.840.10008.1.20.1";

/// Asks for a commitment; the data set follows.
inline std::string commitmentCommand()
{
    return command(element(0, 3, kCommitment) + element(0, 0x100, littleEndian(0x130, 2)) +
                   element(0, 0x110, littleEndian(1, 2)) + element(0, 0x800, littleEndian(1, 2)) +
                   element(0, 0x1001, "1.2.840.10008.1.20.1.1") + element(0, 0x1008, littleEndian(1, 2)));
}

}  // namespace vicon::test::wire
