# Turns the columns that bench/*.sh print into the tables of docs/results.md: bash bench/peers.sh | awk -f bench/markdown.awk
# Columns are two blanks or more apart, or a bar; lines of one column stay as they are.
{
  gsub(/ *\| */, "   ")
  sub(/^ +/, "")
  n = split($0, column, /  +/)
  if (n < 3) {
    print
    is_table = 0
    next
  }
  row = "|"
  rule = "|"
  for (i = 1; i <= n; ++i) {
    row = row " " column[i] " |"
    rule = rule "---|"
  }
  print row
  if (!is_table) print rule
  is_table = 1
}
