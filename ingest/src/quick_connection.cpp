#include "quick_connection.h"

#include <linux/tcp.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace vicon::ingest {

void acknowledgeAtOnce(int socket)
{
    const int on = 1;
    ::setsockopt(socket, IPPROTO_TCP, TCP_QUICKACK, &on, sizeof on);
}

}  // namespace vicon::ingest
