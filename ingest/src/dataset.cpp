#include "dataset.h"

#include <cmath>

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

}  // namespace

Dataset::Dataset(DcmItem& item, std::vector<std::string> outer_character_sets)
    : item_(&item), character_sets_(std::move(outer_character_sets))
{
    if (item.tagExistsWithValue(DCM_SpecificCharacterSet))
        character_sets_ = values(DCM_SpecificCharacterSet);
}

std::string Dataset::raw(const DcmTagKey& tag) const
{
    OFString value;
    if (item_->findAndGetOFStringArray(tag, value).bad())
        return {};
    return {value.c_str(), value.size()};
}

std::vector<std::string> Dataset::values(const DcmTagKey& tag) const
{
    const std::string all = raw(tag);
    std::vector<std::string> out;
    if (all.empty())
        return out;
    for (std::size_t from = 0; from <= all.size();) {
        const std::size_t to = std::min(all.find('\\', from), all.size());
        out.push_back(trimmed(all.substr(from, to - from)));
        from = to + 1;
    }
    return out;
}

std::string Dataset::text(const DcmTagKey& tag) const
{
    return trimmed(toUtf8(raw(tag), character_sets_, TextKind::single_line));
}

std::string Dataset::personName(const DcmTagKey& tag) const
{
    return tidyPersonName(toUtf8(raw(tag), character_sets_, TextKind::person_name));
}

std::optional<double> Dataset::number(const DcmTagKey& tag, unsigned long index) const
{
    Float64 value = 0;
    DcmElement* element = nullptr;
    if (item_->findAndGetElement(tag, element).bad() || !element || element->getLength() == 0)
        return {};
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

unsigned long Dataset::itemCount(const DcmTagKey& sequence) const
{
    DcmSequenceOfItems* found = nullptr;
    return item_->findAndGetSequence(sequence, found).good() && found ? found->card() : 0;
}

}  // namespace vicon::ingest
