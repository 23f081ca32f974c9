#pragma once

#include <cstdint>
#include <string>

namespace vicon::ingest {

/// What stands for a patient in anonymous objects: the same for the same, and nothing that those who lack the key could
/// hold against a name.
class Pseudonyms {
public:
    /// @param key secret
    /// @param patient what tells this patient from others
    Pseudonyms(std::string key, const std::string& patient);

    std::string patient() const { return patient_; }
    /// UIDs of the standard itself stay.
    std::string uid(const std::string& original) const;
    /// "YYYYMMDD" and "HHMMSS.FFFFFF" of the same moment, both earlier by the patient's span; what is no date gives
    /// nothing. Without a time, the day alone.
    struct Moment {
        std::string date, time;
    };
    Moment earlier(const std::string& date, const std::string& time) const;
    /// "YYYYMMDDHHMMSS.FFFFFF&ZZXX", without its zone.
    std::string earlier(const std::string& date_time) const;

private:
    std::string key_, patient_;
    std::int64_t earlier_s_ = 0;
};

}  // namespace vicon::ingest
