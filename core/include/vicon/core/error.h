#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace vicon {

/// Why something failed; the name is what the log and `--json` print.
enum class ErrorCode {
    wrong_use,      ///< the command line or the configuration is wrong; exit code 2
    bad_input,      ///< a file, a peer's object or an argument's content cannot be used
    not_found,      ///< the named case, scan, marker or file does not exist
    not_ready,      ///< it exists, but a step that it needs has not been done
    unusable_scan,  ///< the scan was processed and holds no colon that can be read
    store,          ///< the store's folder or a file in it cannot be read or written
    database,       ///< the database refused
    no_memory,      ///< memory that the work needs cannot be had
    no_display,     ///< no picture can be rendered here
    peer,           ///< a DICOM peer cannot be reached or refused
    cancelled,      ///< the user or a signal stopped the work
    lease_lost,     ///< another worker owns the job now
    internal,       ///< a defect of VICON
};

std::string_view nameOf(ErrorCode code);

/// The one exception of every VICON library. Only `app` prints it and exits.
class Error : public std::runtime_error {
public:
    /// @param what_happened what was wrong, without a patient's name
    /// @param subject the file, peer or case it happened to; may be empty
    /// @param remedy what the user can do; may be empty
    Error(ErrorCode code, const std::string& what_happened, std::string subject = {}, std::string remedy = {});

    ErrorCode code() const { return code_; }
    const std::string& subject() const { return subject_; }
    const std::string& remedy() const { return remedy_; }

private:
    ErrorCode code_;
    std::string subject_;
    std::string remedy_;
};

}  // namespace vicon
