#!/usr/bin/env bash
# Makes pages of the Python package from its docstrings, with Debian's Sphinx, which it installs if it is missing.
#   jobs/api.sh [FOLDER]     into FOLDER (default: build/api); open FOLDER/index.html in a browser
set -euo pipefail
. "$(dirname "$0")/arguments.sh"
read_arguments "" 1 "$@"
pages=$(folder_argument "${words[0]:-$(dirname "$0")/../build/api}")
cd "$(dirname "$0")/.."

jobs/prepare.sh --packages python3-sphinx
sources=$(mktemp -d)
trap 'rm -rf "$sources"' EXIT
/usr/bin/python3 postprocess/api/sources.py "$sources"
# A warning ends it. Nothing of the package is written into the checkout.
PYTHONDONTWRITEBYTECODE=1 MPLBACKEND=agg /usr/bin/python3 -m sphinx -q -E -W --keep-going -b html -c postprocess/api -d "$sources/read" "$sources" "$pages"
echo "$pages/index.html"
