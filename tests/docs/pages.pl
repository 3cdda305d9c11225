#!/usr/bin/perl
# pages.pl < LIST: checks the Markdown files of LIST, as pages.sh says; paths are relative to the folder that it runs in.
use strict;
use warnings;
# Debian's smallest perl has no module open.
binmode $_, ':utf8' for *STDIN, *STDOUT, *STDERR;

my %most = (words_in_sentence => 25, words_in_sentence_of_docs => 35, lines => 80, top_lines => 150, top_words => 1500, words_of_the_glossary => 60);
my $failures = 0;

sub fail {
    my ($file, $line, $expected, $found) = @_;
    print "$file:$line: expected $expected, found $found\n";
    $failures++;
}

# A page as blocks: { kind => text, row or heading, line => where it begins, text => its lines }. No code. Each item of a list, each
# row of a table is one block.
sub blocks_of {
    my ($lines) = @_;
    my @blocks;
    my ($is_fenced, $is_code, $goes_on) = (0, 0, 0);
    for my $number (1 .. @$lines) {
        my $line = $lines->[$number - 1];
        if ($line =~ /^\s*```/) { $is_fenced = !$is_fenced; $goes_on = 0; next; }
        next if $is_fenced;
        if ($line !~ /\S/) { $goes_on = 0; next; }
        # Four blanks begin code, unless they continue a paragraph.
        $is_code = $line =~ /^(?: {4}|\t)/ && ($is_code || !$goes_on);
        if ($is_code) { $goes_on = 0; next; }
        my $kind = $line =~ /^#/ ? 'heading' : $line =~ /^\s*\|/ ? 'row' : 'text';
        $goes_on = 0 if $kind ne 'text' || $line =~ s/^\s*(?:[-*]|\d+\.)\s+//;
        if ($goes_on) { $blocks[-1]{text} .= "\n$line"; next; }
        push @blocks, {kind => $kind, line => $number, text => $line};
        $goes_on = $kind eq 'text';
    }
    return \@blocks;
}

# On which line a place of a text is.
sub line_at {
    my ($first_line, $text, $place) = @_;
    return $first_line + (substr($text, 0, $place) =~ tr/\n//);
}

# `a b` as one word of the same length, which holds no link, no end of a sentence.
sub without_code {
    my ($text) = @_;
    $text =~ s/`([^`]*)`/'x' . ($1 =~ s{[^\n]}{x}gr) . 'x'/ge;
    return $text;
}

my $link = qr/\]\(([^()\s]+)\)/;

# A sentence ends with a mark and what closes behind it, or with its block, so before a list, a table or code. No semicolon or colon
# ends one, nor does the point of `Fig. 3` or the last of `...`.
my $end_of_sentence = qr/(?<!\bFig)(?<!\bFigs)(?<!\.)[.?!]["')*_\]]*(?=\s)|\z/;

sub read_page {
    my ($file) = @_;
    open my $in, '<:utf8', $file or die "pages.pl: $file: $!\n";
    chomp(my @lines = <$in>);
    return {lines => \@lines, blocks => blocks_of(\@lines)};
}

# The anchors of a page's headings, as GitHub and GitLab make them.
sub anchors_of {
    my ($page) = @_;
    my (%anchors, %times);
    for my $heading (grep { $_->{kind} eq 'heading' } @{$page->{blocks}}) {
        my $name = lc $heading->{text} =~ s/^#+\s*//r =~ s/$link/]/gr;
        $name = $name =~ s/[^\w\- ]//gr =~ s/ /-/gr;
        my $before = $times{$name}++;
        $anchors{$before ? "$name-$before" : $name} = 1;
    }
    return \%anchors;
}

# `docs/../kernels/x` as `kernels/x`; what leads out of the tree keeps its dots.
sub plain_path {
    my @parts;
    for my $part (split m{/}, shift) {
        next if $part eq '' || $part eq '.';
        if ($part eq '..' && @parts && $parts[-1] ne '..') { pop @parts; next; }
        push @parts, $part;
    }
    return join('/', @parts) || '.';
}

chomp(my @files = <STDIN>);
my %pages = map { $_ => read_page($_) } @files;

for my $file (@files) {
    my $folder = $file =~ m{^(.*/)} ? $1 : '';
    for my $block (@{$pages{$file}{blocks}}) {
        my $text = without_code($block->{text});
        while ($text =~ /$link/g) {
            my $target = substr($block->{text}, $-[1], $+[1] - $-[1]);
            my $line = line_at($block->{line}, $text, $-[1]);
            next if $target =~ /^[a-z]+:/;
            my ($path, $anchor) = $target =~ /^([^#]*)(?:#(.*))?$/;
            my $there = $path eq '' ? $file : plain_path("$folder$path");
            if ($there =~ /^\.\./ || !-e $there) {
                fail($file, $line, 'a link that leads somewhere', "($target), and no $there");
            } elsif (defined $anchor && !($pages{$there} && anchors_of($pages{$there})->{$anchor})) {
                fail($file, $line, 'an anchor that is there', "($target), and no such heading in $there");
            }
        }
    }
}

for my $file (@files) {
    my $first = $pages{$file}{lines}[0] // '';
    fail($file, 1, 'the title, # and words', $first) if $first !~ /^# \S/;
}

# A language of more words than this nobody learns.
for my $file (grep { $_ eq 'docs/glossary.md' } @files) {
    my $words = grep { /^\| (?!word \|)\w/ } @{$pages{$file}{lines}};
    fail($file, 1, "at most $most{words_of_the_glossary} words", $words) if $words > $most{words_of_the_glossary};
}

for my $file (grep { m{(?:^|/)README\.md$} } @files) {
    my @lines = @{$pages{$file}{lines}};
    my $most_lines = $file eq 'README.md' ? $most{top_lines} : $most{lines};
    fail($file, scalar @lines, "at most $most_lines lines", scalar @lines) if @lines > $most_lines;
    if ($file eq 'README.md') {
        my $words = map { split ' ' } @lines;
        fail($file, scalar @lines, "at most $most{top_words} words", $words) if $words > $most{top_words};
    }
}

# What a sentence of a page may have. What commands print is held to nothing.
sub most_words_in_sentence {
    my ($file) = @_;
    return $most{words_in_sentence} if $file =~ m{(?:^|/)README\.md$};
    return if $file =~ m{^docs/measured/} || $file !~ m{^(?:docs/|CHANGELOG\.md$)};
    return $most{words_in_sentence_of_docs};
}

for my $file (grep { most_words_in_sentence($_) } @files) {
    my $most = most_words_in_sentence($file);
    for my $block (grep { $_->{kind} eq 'text' } @{$pages{$file}{blocks}}) {
        my $text = without_code($block->{text}) =~ s/$link/]/gr;
        while ($text =~ /\G\s*(\S.*?(?:$end_of_sentence))/gs) {
            my $line = line_at($block->{line}, $text, $-[1]);
            my $sentence = $1 =~ s/\s+/ /gr;
            my $words = grep { /\w/ } split ' ', $sentence;
            fail($file, $line, "a sentence of at most $most words", "$words: $sentence") if $words > $most;
        }
    }
}
exit($failures ? 1 : 0);
