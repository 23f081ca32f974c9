#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmnet/assoc.h>

#include <memory>

#include "lobby.h"

namespace vicon::ingest {

/// Has DCMTK read the association requests of callers whose connections it did not accept itself.
class AssociationReader {
public:
    /// Throws Error{peer} when the network cannot be used.
    AssociationReader(int port, int timeout_s);
    ~AssociationReader();
    AssociationReader(const AssociationReader&) = delete;
    AssociationReader& operator=(const AssociationReader&) = delete;

    struct Read {
        T_ASC_Association* association = nullptr;
        std::shared_ptr<const MessageWatch> watch;  ///< of its connection
    };
    /// Takes over the connection of a caller whose request is there as a whole: reading it does not wait. No
    /// association when it is none.
    Read read(Caller caller);

private:
    class Layer;
    std::unique_ptr<Layer> layer_;
    T_ASC_Network* network_ = nullptr;
};

}  // namespace vicon::ingest
