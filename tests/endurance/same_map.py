"""Whether two map files hold the same, outside /run.   usage: same_map.py FILE EXPECTED"""

import os
import sys

os.environ.setdefault("PETERKA_BINARY", "")
import parts  # noqa: F401 - for the path of the next one
import map_contents

map_contents.assert_same_map(*sys.argv[1:])
