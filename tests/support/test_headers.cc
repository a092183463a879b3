// Nothing: what CMake precompiles for the tests belongs to a target, and a target has a source.
