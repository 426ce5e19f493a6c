"""Whether two map files have the same contents, outside /run.   usage: same_map.py FILE EXPECTED"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "end_to_end"))
import map_contents

map_contents.assert_same_map(*sys.argv[1:])
