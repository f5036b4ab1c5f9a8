#!/bin/sh
# Make static/fonts/noto-sans-arabic.woff2 from the whole variable font: Arabic letters only, one width, weights 400 to 800.
# Needs fonttools with brotli (pip install fonttools brotli), which the project itself does not.
# usage: scripts/subset_fonts.sh 'NotoSansArabic[wdth,wght].ttf' static/fonts/noto-sans-arabic.woff2
set -eu

source=${1:?usage: subset_fonts.sh SOURCE.ttf TARGET.woff2}
target=${2:?usage: subset_fonts.sh SOURCE.ttf TARGET.woff2}
narrowed=$(mktemp --suffix=.ttf)
trap 'rm -f "$narrowed"' EXIT

fonttools varLib.instancer "$source" wdth=100 wght=400:800 --output "$narrowed"
# Arabic with its supplement, joiners and direction marks, ornate parentheses. Joined forms come with the layout rules.
pyftsubset "$narrowed" --output-file="$target" --flavor=woff2 --layout-features='*' --no-hinting --desubroutinize \
    --unicodes='U+0600-06FF,U+0750-077F,U+200C-200F,U+FD3E-FD3F'
ls -l "$target"
