#pragma once

namespace regoplan {

/// What this process can still take without being refused or killed: the least of what the machine
/// has left, its control group and its own limits allow.
double available_memory_bytes();

}  // namespace regoplan
