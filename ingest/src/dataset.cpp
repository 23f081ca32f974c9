#include "dataset.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "vicon/core/printable.h"

namespace vicon::ingest {
namespace {

std::string trimmed(std::string text)
{
    const char* const kPadding = " \0";
    const std::string_view padding(kPadding, 2);
    text.erase(text.find_last_not_of(padding) + 1);
    text.erase(0, text.find_first_not_of(' ') == std::string::npos ? 0 : text.find_first_not_of(' '));
    return text;
}

/// Bytes in any amount, or of a kind that nobody knows: no text, whatever the tag says. A library would spell out each.
bool isBulk(const DcmElement& element)
{
    return element.ident() != EVR_UN && dynamic_cast<const DcmOtherByteOtherWord*>(&element);
}

/// All values of an element together: more than the 65,534 bytes that a length of two bytes can say.
constexpr std::size_t kLongestValues_bytes = 1 << 16;
/// More than there are, and an item has its own copies.
constexpr std::size_t kMostCharacterSets = 16;

/// At most so many bytes, not from the middle of a character of UTF-8.
std::string_view cut(std::string_view text, std::size_t most)
{
    if (text.size() <= most)
        return text;
    const auto continues = [&](std::size_t at) { return (std::uint8_t(text[at]) & 0xc0) == 0x80; };
    constexpr std::size_t kLongestCharacter = 4;
    std::size_t to = most;
    while (to > 0 && most - to < kLongestCharacter && continues(to))
        --to;
    return text.substr(0, to);
}

constexpr const char* kCutMark = "…";

/// What an element holds that was written without saying its kind.
std::string bytesOf(DcmElement& element)
{
    Uint8* bytes = nullptr;
    if (element.getLength() == 0 || element.getUint8Array(bytes).bad() || !bytes)
        return {};
    return {reinterpret_cast<const char*>(bytes), element.getLength()};
}

std::string valueAt(DcmElement& element, unsigned long index)
{
    OFString value;
    if (element.getOFString(value, index).bad())
        return {};
    return trimmed({value.c_str(), value.size()});
}

/// Whether a text is a decimal string as the standard writes it: "nan" and "inf" are none.
bool isDecimal(const std::string& text)
{
    double value = 0;
    const char* begin = text.c_str() + (text.starts_with('+') ? 1 : 0);
    const auto [end, failure] = std::from_chars(begin, text.c_str() + text.size(), value);
    return failure == std::errc() && end == text.c_str() + text.size() && std::isfinite(value);
}

/// One comma and no point: what a program writes whose language has decimal commas.
bool hasComma(const std::string& text)
{
    return std::count(text.begin(), text.end(), ',') == 1 && text.find('.') == std::string::npos;
}

std::optional<double> fromCommaDecimal(std::string text)
{
    if (!hasComma(text))
        return {};
    std::replace(text.begin(), text.end(), ',', '.');
    if (!isDecimal(text))
        return {};
    const double value = std::strtod(text.c_str(), nullptr);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

template <class T>
std::optional<double> binaryAt(const std::string& bytes, unsigned long index)
{
    T value{};
    if (bytes.size() < (index + 1) * sizeof value)
        return {};
    std::memcpy(&value, bytes.data() + index * sizeof value, sizeof value);  // little-endian, as this machine
    return std::isfinite(double(value)) ? std::optional(double(value)) : std::nullopt;
}

/// A number of an element that was written as UN, by what the dictionary says of it.
std::optional<double> numberFrom(const std::string& bytes, DcmEVR vr, unsigned long index)
{
    switch (vr) {
        case EVR_US:
        case EVR_xs:
            return binaryAt<std::uint16_t>(bytes, index);
        case EVR_SS:
            return binaryAt<std::int16_t>(bytes, index);
        case EVR_UL:
            return binaryAt<std::uint32_t>(bytes, index);
        case EVR_SL:
            return binaryAt<std::int32_t>(bytes, index);
        case EVR_FL:
            return binaryAt<float>(bytes, index);
        case EVR_FD:
            return binaryAt<double>(bytes, index);
        default:
            break;
    }
    std::size_t from = 0;
    for (; index > 0; --index) {
        from = bytes.find('\\', from);
        if (from == std::string::npos)
            return {};
        ++from;
    }
    const std::string text = trimmed(bytes.substr(from, std::min(bytes.find('\\', from), bytes.size()) - from));
    return isDecimal(text) ? std::optional(std::strtod(text.c_str(), nullptr)) : fromCommaDecimal(text);
}

}  // namespace

Dataset::Dataset(DcmItem& item, std::vector<std::string> outer_character_sets)
    : item_(&item), character_sets_(std::move(outer_character_sets))
{
    if (item.tagExistsWithValue(DCM_SpecificCharacterSet))
        character_sets_ = values(DCM_SpecificCharacterSet);
    character_sets_.resize(std::min(character_sets_.size(), kMostCharacterSets));
}

std::string Dataset::raw(const DcmTagKey& tag) const
{
    OFString value;
    DcmElement* element = nullptr;
    if (item_->findAndGetElement(tag, element).bad() || !element || isBulk(*element))
        return {};
    if (element->ident() == EVR_UN)
        return std::string(cut(bytesOf(*element), kLongestValues_bytes));
    if (element->getLength() > kLongestValues_bytes) {  // copied by a library at every look, or spelled out
        char* text = nullptr;
        Uint32 length = 0;
        if (!dynamic_cast<DcmByteString*>(element) || element->getString(text, length).bad() || !text)
            return {};
        return std::string(cut({text, length}, kLongestValues_bytes));
    }
    if (element->getOFStringArray(value).bad())
        return {};
    return {value.c_str(), value.size()};
}

bool Dataset::isCut(const DcmTagKey& tag) const
{
    return trimmed(raw(tag)).size() > kLongestText_bytes;
}

std::string Dataset::shown(const DcmTagKey& tag, TextKind kind) const
{
    const std::string whole = trimmed(raw(tag));
    const std::string text = toUtf8(cut(whole, kLongestText_bytes), character_sets_, kind);
    return printable(kind == TextKind::person_name ? tidyPersonName(text) : trimmed(text)) +
           (whole.size() > kLongestText_bytes ? kCutMark : "");
}

std::vector<std::string> Dataset::values(const DcmTagKey& tag) const
{
    const std::string all = toUtf8(raw(tag), character_sets_, TextKind::single_line);
    std::vector<std::string> out;
    if (all.empty())
        return out;
    for (std::size_t from = 0; from <= all.size();) {
        const std::size_t to = std::min(all.find('\\', from), all.size());
        out.push_back(printable(trimmed(std::string(cut(all.substr(from, to - from), kLongestText_bytes)))));
        from = to + 1;
    }
    return out;
}

std::string Dataset::text(const DcmTagKey& tag) const
{
    return shown(tag, TextKind::single_line);
}

std::string Dataset::longText(const DcmTagKey& tag) const
{
    const std::string all = toUtf8(raw(tag), character_sets_, TextKind::single_line);
    std::string out;
    for (std::size_t from = 0; from < all.size();) {
        const std::size_t to = std::min(all.find('\n', from), all.size());
        std::string line = all.substr(from, to - from);
        if (line.ends_with('\r'))
            line.pop_back();
        out += printable(line) + (to < all.size() ? "\n" : "");
        from = to + 1;
    }
    return trimmed(out) + (all.size() >= kLongestValues_bytes ? kCutMark : "");
}

std::string Dataset::personName(const DcmTagKey& tag) const
{
    return shown(tag, TextKind::person_name);
}

std::optional<double> Dataset::number(const DcmTagKey& tag, unsigned long index) const
{
    Float64 value = 0;
    DcmElement* element = nullptr;
    if (item_->findAndGetElement(tag, element).bad() || !element || element->getLength() == 0)
        return {};
    if (element->ident() == EVR_UN)
        return numberFrom(bytesOf(*element), DcmTag(tag).getEVR(), index);
    if (element->ident() == EVR_DS)
        if (const auto written = valueAt(*element, index); !isDecimal(written))
            return fromCommaDecimal(written);
    if (element->getFloat64(value, index).good())
        return std::isfinite(value) ? std::optional(value) : std::nullopt;
    Uint16 small = 0;
    if (element->getUint16(small, index).good())
        return small;
    Sint16 small_signed = 0;
    if (element->getSint16(small_signed, index).good())
        return small_signed;
    Sint32 whole = 0;
    if (element->getSint32(whole, index).good())
        return whole;
    Uint32 natural = 0;
    if (element->getUint32(natural, index).good())
        return natural;
    return {};
}

bool Dataset::hasDecimalComma(const DcmTagKey& tag) const
{
    const std::string values = raw(tag);
    return hasComma(values.substr(0, values.find('\\')));
}

std::optional<int> Dataset::integer(const DcmTagKey& tag) const
{
    const auto value = number(tag);
    if (!value || std::abs(*value) > 2e9)
        return {};
    return int(*value);
}

bool Dataset::has(const DcmTagKey& tag) const
{
    return item_->tagExists(tag);
}

std::optional<Dataset> Dataset::item(const DcmTagKey& sequence, long index) const
{
    DcmItem* found = nullptr;
    if (item_->findAndGetSequenceItem(sequence, found, index).bad() || !found)
        return {};
    return Dataset(*found, character_sets_);
}

std::vector<Dataset> Dataset::items(const DcmTagKey& sequence) const
{
    std::vector<Dataset> out;
    DcmSequenceOfItems* found = nullptr;
    if (item_->findAndGetSequence(sequence, found).bad() || !found)
        return out;
    for (DcmObject* next = found->nextInContainer(nullptr); next; next = found->nextInContainer(next))
        if (auto* item = dynamic_cast<DcmItem*>(next))
            out.push_back(Dataset(*item, character_sets_));
    return out;
}

unsigned long Dataset::itemCount(const DcmTagKey& sequence) const
{
    DcmSequenceOfItems* found = nullptr;
    return item_->findAndGetSequence(sequence, found).good() && found ? found->card() : 0;
}

}  // namespace vicon::ingest
