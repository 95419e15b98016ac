#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

namespace regoplan {

/// A port of this machine at which nobody answers; it tells who has called.
class Listener {
 public:
  Listener() : socket_(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(bind(socket_, any, size), 0);
    EXPECT_EQ(listen(socket_, 16), 0);
    EXPECT_EQ(getsockname(socket_, any, &size), 0);
    port_ = ntohs(address.sin_port);
    address_ = "http://127.0.0.1:" + std::to_string(port_);
  }
  ~Listener() { close(socket_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  const std::string& address() const { return address_; }
  int port() const { return port_; }

  /// Whether anybody has called since this was asked last.
  bool was_called() const {
    bool called = false;
    for (int caller = accept(socket_, nullptr, nullptr); caller >= 0;
         caller = accept(socket_, nullptr, nullptr)) {
      close(caller);
      called = true;
    }
    return called;
  }

 private:
  int socket_;
  int port_ = 0;
  std::string address_;
};

}  // namespace regoplan
