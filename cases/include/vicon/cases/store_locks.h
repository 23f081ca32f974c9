#pragma once

#include <filesystem>
#include <string>

#include "vicon/core/progress.h"

namespace vicon {

/// Only one import of a study, deletion or backup changes or copies what a store holds at a time. Waits for the lock,
/// and holds it while the object lives. Who locks again and again lets in between who waits.
class StoreLock {
public:
    /// @param done of the caller's work, told while it waits
    /// Throws Error{store}, Error{cancelled}.
    StoreLock(const std::filesystem::path& store, Progress& progress, double done = 0);
    ~StoreLock();
    StoreLock(const StoreLock&) = delete;
    StoreLock& operator=(const StoreLock&) = delete;

private:
    int descriptor_;
};

/// Somebody has a case open for as long as this object lives: nobody can delete it. Any number may. Where the lock
/// cannot be had the case is being deleted, or its store cannot be written to; who reads on gets an error.
class CaseInUse {
public:
    CaseInUse(const std::filesystem::path& store, const std::string& case_id) noexcept;
    ~CaseInUse();
    CaseInUse(const CaseInUse&) = delete;
    CaseInUse& operator=(const CaseInUse&) = delete;

private:
    int descriptor_;
};

/// Nobody has the case open, and nobody can open it while this object lives.
class CaseUnused {
public:
    /// Throws Error{store} where it is open.
    CaseUnused(const std::filesystem::path& store, const std::string& case_id);
    ~CaseUnused();
    CaseUnused(const CaseUnused&) = delete;
    CaseUnused& operator=(const CaseUnused&) = delete;
    /// The case is gone, and its lock with it.
    void forget();

private:
    std::filesystem::path file_;
    int descriptor_;
};

}  // namespace vicon
