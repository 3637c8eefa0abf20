#include "services/image/files.h"
