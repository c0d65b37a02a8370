// The one place where tinyobjloader is compiled: Debian's shared library is built for float.
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>
