#include "web_json.h"

#include "association.h"
#include "vicon/core/error.h"
#include "vicon/core/printable.h"

using nlohmann::json;

namespace vicon::ingest {
namespace {

std::string textOf(const json& value)
{
    if (value.is_string())
        return printable(value.get<std::string>());
    return value.is_number() ? value.dump() : "";
}

}  // namespace

const json* WebItem::values(const char* tag) const
{
    if (!json_->is_object() || !json_->contains(tag))
        return nullptr;
    const json& attribute = json_->at(tag);
    if (!attribute.is_object() || !attribute.contains("Value") || !attribute.at("Value").is_array())
        return nullptr;
    return &attribute.at("Value");
}

std::string WebItem::text(const char* tag) const
{
    std::string all;
    bool first = true;
    if (const json* const list = values(tag))
        for (const json& value : *list) {
            all += (first ? "" : "\\") + textOf(value);
            first = false;
        }
    return all;
}

std::string WebItem::personName(const char* tag) const
{
    const json* const list = values(tag);
    if (!list || list->empty() || !list->front().is_object())
        return text(tag);
    std::string name, after;
    for (const char* group : {"Alphabetic", "Ideographic", "Phonetic"}) {
        const std::string part = list->front().contains(group) ? textOf(list->front().at(group)) : "";
        if (!part.empty()) {
            name.append(after).append(part);
            after.clear();
        }
        after += '=';
    }
    return name;
}

int WebItem::count(const char* tag) const
{
    const json* const list = values(tag);
    if (!list || list->empty())
        return -1;
    const json& value = list->front();
    constexpr int kMost = 1000000000;
    if (value.is_number_integer() && value >= 0 && value <= kMost)
        return value;
    // Some write what is a string in DICOM as one in JSON.
    const std::string digits = value.is_string() ? value.get<std::string>() : "";
    const bool is_number =
        !digits.empty() && digits.size() < 10 && digits.find_first_not_of("0123456789") == std::string::npos;
    return is_number ? std::stoi(digits) : -1;
}

std::vector<WebItem> WebItem::items(const char* tag) const
{
    std::vector<WebItem> all;
    if (const json* const list = values(tag))
        for (const json& value : *list)
            all.emplace_back(value);
    return all;
}

json listFrom(const WebClient& client, const WebClient::Answer& answer)
{
    if (answer.body.empty())
        return json::array();
    json parsed = json::parse(answer.body, nullptr, false);
    if (!parsed.is_array())
        throw Error(ErrorCode::peer, "the peer's answer is not in DICOM's JSON", nameOf(client.peer()),
                    "check its url: it is the root of its DICOMweb service");
    return parsed;
}

}  // namespace vicon::ingest
