#!/usr/bin/env bash
# Installs what docs/guide/recipes.md needs and runs its blocks: tests/recipes/test.sh. VENV has irbkin
# and pytest. Where a package cannot be installed, they are skipped with the reason.
set -euo pipefail
cd "$(dirname "$0")/../.."
if tests/step.sh "Install what recipes need" tests/venv.sh recipes; then
    tests/step.sh "Recipes" "$VENV/bin/python" -m pytest --quiet -m recipes
else
    echo "SKIPPED: recipes were not run: their packages cannot be installed (the reason is above)"
fi
