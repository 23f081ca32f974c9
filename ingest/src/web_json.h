#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "web_client.h"

namespace vicon::ingest {

/// An item of DICOM's JSON model (PS3.18 F.2): absent and malformed attributes are empty. Texts are printable UTF-8.
class WebItem {
public:
    explicit WebItem(const nlohmann::json& json) : json_(&json) {}
    /// @param tag eight hexadecimal digits in upper case
    /// All values, joined by backslashes.
    std::string text(const char* tag) const;
    std::string personName(const char* tag) const;
    /// -1 where there is none.
    int count(const char* tag) const;
    std::vector<WebItem> items(const char* tag) const;

private:
    const nlohmann::json* values(const char* tag) const;
    const nlohmann::json* json_;
};

/// The list that an answer holds; an empty answer is an empty list. Throws Error{peer} for what is none.
nlohmann::json listFrom(const WebClient& client, const WebClient::Answer& answer);

}  // namespace vicon::ingest
