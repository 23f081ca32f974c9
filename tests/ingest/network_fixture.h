#pragma once

#include "dicom_writer.h"
#include "running_receiver.h"
#include "store_fixture.h"

namespace vicon::test {

/// A store with its folder of incoming objects, as a receiver has it.
class Network : public StoreFixture {
protected:
    std::filesystem::path incoming = store.folder() / "incoming";
    std::size_t filesIn(const std::filesystem::path& where)
    {
        std::size_t count = 0;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(where))
            count += entry.is_regular_file() && entry.path().extension() == ".dcm" ? 1 : 0;
        return count;
    }
};

}  // namespace vicon::test
