#!/usr/bin/perl
# draw.pl ROOT SEED COUNT AREA: draws one-line changes of the product's code at random. Prints for each a line as planted/bugs.txt
# has them, with its place, LINE:COLUMN, instead of a symbol. The same seed draws the same from the same code. What is in comments,
# in texts, in what a refusal says, in includes and in the lists of names (*.def) is no code; equivalent.txt says which changes
# alter nothing. Left out as whole classes, since no answer depends on them: what shows progress on a terminal; reserve(), which
# only saves time; and, in the files that lay out pictures alone, numbers (where a key or a margin lies), and in
# bench/run/pieces.cpp (how long work is expected to take, by which shards are dealt). Their other code is drawn, as is every
# threshold elsewhere.
use strict;
use warnings;

my ($root, $seed, $count, $area) = @ARGV;
my $check = $seed eq '--check';
($seed, $count, $area) = (0, 0, 'all') if $check;
my @areas = $area eq 'all' ? qw(kernels bench qemu gap drive) : ($area);
# What every room uses is drawn with the room that uses most of it.
my %folders = (bench => "bench base reference");

# Park and Miller's generator: exact in a double, the same everywhere.
my $state = ($seed % 2147483646) + 1;
sub draw { my ($below) = @_; $state = ($state * 16807) % 2147483647; return $state % $below; }
draw(2) for 1 .. 10;

my %equivalent;
if (open my $list, '<', "$root/tests/mutants/equivalent.txt") {
    while (<$list>) { $equivalent{"$1 | $2"} = 1 if /^([^#\s][^|]*?) \| [^|]+ \| (.*)$/; }
}

# Operators as they stand in our format, between spaces; each with what it is swapped for.
my %swapped = (
    '+' => '-', '-' => '+', '*' => '/', '/' => '*', '<' => '<=', '<=' => '<', '>' => '>=', '>=' => '>',
    '==' => '!=', '!=' => '==', '&&' => '||', '||' => '&&', '+=' => '-=', '-=' => '+=', '*=' => '/=', '/=' => '*=',
    '>>' => '<<', '&' => '|', '|' => '&',
);

# In names, which a shell reads.
my %words = (
    '+' => 'plus', '-' => 'minus', '*' => 'times', '/' => 'by', '<' => 'below', '<=' => 'at-most', '>' => 'above', '>=' => 'at-least',
    '==' => 'equal', '!=' => 'other', '&&' => 'and', '||' => 'or', '+=' => 'add', '-=' => 'take', '*=' => 'multiply', '/=' => 'divide',
    '>>' => 'right', '<<' => 'left', '&' => 'bits-and', '|' => 'bits-or',
);
sub spelled { my ($text) = @_; return $words{$text} // $text =~ s/ \* 1\.01$/-and-1%/r; }

# The places of a line where a change may be: [column, old, new]. Its texts and comments are blanked.
sub places {
    my ($code) = @_;
    my @found;
    while ($code =~ / (\S+) (?=\S)/g) {
        my ($word, $at) = ($1, $-[1]);
        pos($code) = $+[1];
        next unless exists $swapped{$word};
        push @found, [$at, $word, $swapped{$word}];
    }
    while ($code =~ /(?<![\w.'])(\d+(?:\.\d+)?(?:e-?\d+)?)(?![\w.'x])/g) {
        my ($number, $at) = ($1, $-[1]);
        next if substr($code, 0, $at) =~ /<[^<>;]*$/ && $number =~ /^\d+$/;  # of a template
        next if $number =~ /[.e]/ && $number == 0;  # a per cent of nothing
        push @found, $number =~ /[.e]/ ? [$at, $number, $number . ' * 1.01'] : [$at, $number, $number + 1],
            ($number =~ /^[1-9]\d*$/ ? [$at, $number, $number - 1] : ());
    }
    push @found, [$-[1], $1, $1 eq 'min' ? 'max' : 'min'] while $code =~ /std::(min|max)\(/g;
    push @found, [$-[1], $1, $1 eq 'true' ? 'false' : 'true'] while $code =~ /\b(true|false)\b/g;
    # A whole statement: an assignment or a call, no declaration and no way out.
    push @found, [length $1, $2, ';']
        if $code =~ /^(\s++)((?!return|throw|break|continue|using|const|auto|static|constexpr|else|case|friend|delete|goto)[\w.\->\[\]*()+ ]+? ?(?:[-+*\/|&]?= |\().*;)\s*$/
        && $code !~ /^\s+[\w:<>]+&?\*? \w+ ?[=({]/;
    return @found;
}

sub code_of {
    my ($code) = @_;
    $code =~ s/"(?:[^"\\]|\\.)*"/'"' . ('~' x (length($&) - 2)) . '"'/ge;
    $code =~ s{'(?:[^'\\]|\\.)'}{"'" . ('~' x (length($&) - 2)) . "'"}ge;
    $code =~ s{//.*$}{' ' x length $&}e;
    return $code;
}

my $no_numbers = qr{^(?:bench/run/pieces|bench/report/plot|bench/studies/equal_cost_plot|bench/studies/horizon_plot|base/gnuplot|bench/report/gain_plot|bench/report/cost_plot|drive/pictures)\.cpp$};
my %places_of;
for my $one (@areas) {
    my @files = grep { !m{/(README|engines|peers|plugin|m7|progress\.)} } split /\n/,
        `cd '$root' && find @{[$folders{$one} // $one]} \\( -name '*.cpp' -o -name '*.hpp' \\) -not -path '*/build/*' | LC_ALL=C sort`;
    for my $file (@files) {
        open my $in, '<', "$root/$file" or die "$file: $!";
        my ($comment, $raw, $foreign, $message) = (0, 0, 0, 0);
        while (my $line = <$in>) {
            chomp $line;
            $raw = 1 if $line =~ /R"\w*\(/;
            # Code of other processors is not compiled here; what is before and behind it is.
            $foreign = $line =~ /^#if.*(__ARM|GLSUM_M7)|^#elif defined\(__aarch64__\)/ if $line =~ /^#(if|el|endif)/;
            # A message goes on to where its call is closed.
            my $code = code_of($line);
            my $within = $message > 0;
            $message = ($within || $line =~ /refuse\(|Failure\(/) ? $message + ($code =~ tr/(//) - ($code =~ tr/)//) : 0;
            my $skip = $raw || $foreign || $comment || $within || $line =~ m{^\s*(#|//|/\*|\*|namespace|static_assert|template|using)} || $line =~ /= (delete|default|0);$/ || $line =~ /fmt::format|refuse\(|Failure\(|notes\.|warnings\.|\.reserve\(|\b[Pp]rogress\b/;
            $raw = 0 if $raw && $line =~ /\)\w*"/;
            $comment = 1 if $line =~ m{/\*} && $line !~ m{\*/};
            $comment = 0 if $line =~ m{\*/};
            next if $skip;
            # What is blanked for the search is as it was where it is put back.
            for (places($code)) {
                next if $file =~ $no_numbers && $_->[1] =~ /^\d/;
                push @{$places_of{$one}}, [$file, $., $_->[0], substr($line, $_->[0], length $_->[1]), $_->[2], $line =~ s/^\s+|\s+$//gr];
            }
        }
    }
}

sub change_of { my ($old, $new) = @_; return $new eq ';' ? 'removed' : spelled($old) . '-to-' . spelled($new); }
# As equivalent.txt has it: without the line's number, with its code.
sub entry_of { my ($file, undef, $column, $old, $new, $code) = @_; return "$file:" . ($column + 1) . ':' . change_of($old, $new) . " | $code"; }

if ($check) {
    delete $equivalent{entry_of(@$_)} for map { @$_ } values %places_of;
    print "equivalent.txt: no such change in today's code: $_\n" for sort keys %equivalent;
    exit(%equivalent ? 1 : 0);
}

my %drawn;
for (my $i = 0; $i < $count;) {
    my $all = $places_of{$areas[$i % @areas]} or die "draw.pl: no code in $areas[$i % @areas]\n";
    my $place = $all->[draw(scalar @$all)];
    my ($file, $line, $column, $old, $new) = @$place;
    my $name = "$file:$line:" . ($column + 1) . ':' . change_of($old, $new);
    next if $drawn{$name}++;
    ++$i;
    if ($equivalent{entry_of(@$place)}) { print "# equivalent: $name\n"; next; }
    print "$name | $file | $line:@{[$column + 1]} | $old => $new\n";
}
