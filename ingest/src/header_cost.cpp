#include "header_cost.h"

#include <algorithm>

namespace vicon::ingest {

std::string HeaderCost::addPart()
{
    if (++elements_ > kMostElements)
        return "it has more than " + std::to_string(kMostElements) + " elements";
    return {};
}

std::string HeaderCost::addElement(ItemTally& item, std::optional<std::uint32_t> tag, std::uint64_t bytes)
{
    if (++item.elements > kMostElementsOfItem)
        return "its data set, or an item, has more than " + std::to_string(kMostElementsOfItem) + " elements";
    if (!tag || (item.elements > 1 && *tag <= item.highest_tag))
        steps_back_ += item.elements;
    if (steps_back_ > kMostStepsBack)
        return tag ? "too many of its elements are not in the order of their tags"
                   : "it has too many elements to be sorted";
    item.highest_tag = std::max(item.highest_tag, tag.value_or(0));
    bytes_ += bytes;
    if (bytes_ > kMostHeaderBytes)
        return "it holds more than " + std::to_string(kMostHeaderBytes / 1000000) + " MB beside its pixels";
    return addPart();
}

}  // namespace vicon::ingest
