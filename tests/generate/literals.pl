# Statements of C in the string literals of C++ files, and in the texts of headers (NAME.h.in), that add or multiply what a sum is made
# of: FILE: STATEMENT each. Exit 1 where there is one. A literal that is put together from several is read as one, with @ for what
# stands between its parts.
use strict;
use warnings;

my $data = qr/\b(?:sum|lost|total|average|step|newest|increment|tail|mean|first|oldest|younger|block|ready|coming|carried|moving|kept
                |inner|term|product|coefficients?|samples?|weight|table|past|[acstx]\d*)\b/x;
my $call = qr/(?<!_)_(?:fused_)?(?:multiply_add|multiply|product|nest|add|carry|smlald|smlad)\(/;
my $found = 0;
for my $file (@ARGV) {
    open(my $in, '<', $file) or die "$file: cannot be read\n";
    my $text = do { local $/; <$in> };
    my $literals = '';
    if ($file =~ /\.h\.in$/) {
        $text =~ s/^%section (?:opening|formula|scaling|summary|sum summary)\n(?:(?!%section).*\n)*//gm;  # prose
        $text =~ s/^ *%(?!text|optional).*\n//gm;
        $text =~ s/^ *%.*\n/;\n/gm;
        $text =~ s/\@[\w .]+\@/\@/g;
        judge($file, $text);
        next;
    }
    while ($text =~ m{\G(?: //[^\n]*
                        | '(?:[^'\\]|\\.)+'
                        | R"(\w*)\((.*?)\)\g{1}"
                        | "((?:[^"\\]|\\.)*)"
                        | (\#[^\n]*)
                        | (;)
                        | (\s+)
                        | (.))}gsx) {
        my ($raw, $literal, $semicolon, $code) = ($2, $3, $5, $7);
        if (defined $raw) {
            $literals .= $raw;
        } elsif (defined $literal) {
            $literals .= $literal =~ s/\\n/\n/gr =~ s/\\"/"/gr;
        } elsif (defined $semicolon) {
            judge($file, $literals);
            $literals = '';
        } elsif (defined $code && $literals !~ /\@ $/) {
            $literals .= ' @ ';
        }
    }
}
exit($found ? 1 : 0);

sub judge {
    my ($file, $text) = @_;
    $text =~ s/\{\d*\}/@/g;                             # what fmt puts in
    $text =~ s{/\*.*?\*/|//[^\n]*|^#[^\n]*}{}gms;
    for my $statement ($text =~ /([^;{}]*);/g) {
        my $values = $statement;
        1 while $values =~ s/\[[^][]*\]//g;          # what is indexed, not by what
        next if $values =~ /\*\s*(?:const )?\w+ = |\b[aSx]_[\w(]/;    # an address, a formula in a comment
        my $operator = $values =~ m{[\w)\@] [-+*/] [\w(\@*&-]|[-+*/]= };
        my $into_itself = $values =~ /([\w\@]+) = [\w\@ ]*\(\1,/;
        if ($values =~ $call || $into_itself || ($operator && $values =~ $data)) {
            $found = 1;
            print "$file: ", $statement =~ s/\s+/ /gr, ";\n";
        }
    }
}
